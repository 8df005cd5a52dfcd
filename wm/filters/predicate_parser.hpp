#pragma once

#include "castor/wm/filters/predicate_tree.hpp"

#include <optional>
#include <string_view>

namespace castor {

/// The tree of a predicate in the notation of `Predicate`; nothing for an empty text. Throws
/// PredicateError.
std::optional<predicate::Node> parse_predicate(std::string_view text);

} // namespace castor
