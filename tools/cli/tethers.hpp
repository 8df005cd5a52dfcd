#pragma once

#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// What binding's unions are made of, and what entries of other subarchitectures belong to: tethers
/// followed in both directions. Entries are as the answers to `wm` have them, with values.
namespace castor::cli {

using Json = nlohmann::ordered_json;

/// Whether a working memory with entries of this type is that of a binding subarchitecture.
bool is_of_binding(const std::string& type);

std::vector<Json> unions_among(const std::vector<Json>& entries);

/// Where tethers of these proxies lead: "vision/SceneObject".
std::set<std::string> tethered_types(const std::vector<Json>& entries);

/// The subarchitectures that tethers of these proxies lead to.
std::set<std::string> tethered_subarchitectures(const std::vector<Json>& entries);

/// A tree for each root that has to do with binding. A root is an entry; what hangs on it is found
/// among `entries`:
///
/// - a union has "proxies", each with the "data" that it is tethered to,
/// - a proxy has its "data" and its "union", with all other proxies of that,
/// - any other entry has the "proxies" that are tethered to it, each with its "union",
/// - relations, unions and proxies, have "ends", each with its "label", its "proxy" and the "union"
///   of that.
///
/// Data that is not among the entries is marked "gone".
std::vector<Json> follow_tethers(const std::vector<Json>& roots, const std::vector<Json>& entries);

/// The same, as people want to read it.
std::string tethers_as_text(const std::vector<Json>& trees);

} // namespace castor::cli
