#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// Readable text for the answers of running systems.
namespace castor::cli {

using Json = nlohmann::ordered_json;

/// The answer to `clock`: "simulated time 12.3 s, as fast as possible, paused".
std::string clock_as_text(const Json& x);

/// The answer to `ps`.
/// @param stats with the counters of every stage of event delivery
std::string system_as_text(const Json& report, bool stats);

/// The answers to `wm`, each about one entry.
std::string entries_as_text(const std::vector<Json>& entries);

/// The answers to `wm` for all entries of the types Action and ActionRegistration.
std::string actions_as_text(const std::vector<Json>& actions, const std::vector<Json>& offers);

/// An event and its value, if there is one, on separate lines.
std::string change_as_text(const Json& change, bool coloured);

/// The usage of entry types by components as a graph in the language of Graphviz: `report` is the
/// answer to `ps`, `accesses` are the answers to `graph`.
std::string usage_as_dot(const Json& report, const std::vector<Json>& accesses);

} // namespace castor::cli
