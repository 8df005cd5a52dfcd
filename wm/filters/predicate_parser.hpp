#pragma once

#include "castor/wm/filters/predicate_tree.hpp"

#include <optional>
#include <string_view>

namespace castor {

/// The tree of a predicate in the notation of `Predicate`, nothing for a text without one. Throws
/// PredicateError.
std::optional<predicate::Node> parse_predicate(std::string_view text);

} // namespace castor
