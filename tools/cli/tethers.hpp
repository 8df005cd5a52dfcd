#pragma once

#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// Tethers followed in both directions: from binding's unions to the entries of other
/// subarchitectures, and back. Entries are answers to `wm`, with values.
namespace castor::cli {

using Json = nlohmann::ordered_json;

/// Whether entries of this type occur only on the working memory of a binding subarchitecture.
bool is_of_binding(const std::string& type);

std::vector<Json> unions_among(const std::vector<Json>& entries);

/// Subarchitectures and types of the entries that these proxies are tethered to:
/// "vision/SceneObject".
std::set<std::string> tethered_types(const std::vector<Json>& entries);

/// Subarchitectures of the entries that these proxies are tethered to.
std::set<std::string> tethered_subarchitectures(const std::vector<Json>& entries);

/// A tree for each root that is related to binding. A root is an entry; its children are found
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

/// The trees as readable text.
std::string tethers_as_text(const std::vector<Json>& trees);

} // namespace castor::cli
