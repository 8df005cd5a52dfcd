#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

/// The usage of entry types by components as an SVG picture: `report` is the answer to `ps`,
/// `accesses` are the answers to `graph`. Subarchitectures are boxes with their working memory and
/// components; solid arrows are writes, dashed ones reads and events, with the types of the entries
/// beside them. Throws std::runtime_error.
std::string usage_as_svg(const nlohmann::ordered_json& report,
                         const std::vector<nlohmann::ordered_json>& accesses);

} // namespace castor::cli
