#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// What systems say of themselves, as people want to read it.
namespace castor::cli {

using Json = nlohmann::ordered_json;

/// The answer to `ps`; with the counters of every stage on the way of an event if `stats`.
std::string system_as_text(const Json& report, bool stats);

/// The answers to `wm`, one entry each.
std::string entries_as_text(const std::vector<Json>& entries);

/// An event and, if there is one, the value, on lines of their own.
std::string change_as_text(const Json& change, bool coloured);

/// Who uses which types of entries, as a graph in the language of Graphviz: `report` is the answer
/// to `ps`, `accesses` those to `graph`.
std::string usage_as_dot(const Json& report, const std::vector<Json>& accesses);

} // namespace castor::cli
