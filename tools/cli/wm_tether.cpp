#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/running_system.hpp"
#include "castor/tools/cli/tethers.hpp"

#include <CLI/App.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

struct TetherArguments {
  std::string system;
  bool json = false;
  /// SUBARCHITECTURE[/ID|TYPE]
  std::string where;
};

/// What binding has, and what that is tethered to.
std::vector<Json> tethered_entries(const RunningSystem& system) {
  auto report = ask_for_one(system, {{"do", "ps"}});
  auto& working_memories = report["working_memories"];
  std::vector<Json> result;
  bool there_is_binding = false;
  auto read = [&](const Json& subarchitecture, const std::string& what) {
    for (auto& x : ask_for_all(
           system,
           {{"do", "wm"}, {"subarchitecture", subarchitecture}, {"what", what}, {"values", true}}))
      result.push_back(x);
  };
  for (auto& wm : working_memories)
    for (auto& [type, count] : wm["entries_by_type"].items())
      if (is_of_binding(type)) {
        there_is_binding = true;
        read(wm["subarchitecture"], type);
      }
  if (!there_is_binding)
    throw std::runtime_error("there is no binding in this system: no working memory has an entry "
                             "of the type BindingProxy, BindingUnion or BinderStatus");
  auto wanted = tethered_subarchitectures(result);
  for (auto& wm : working_memories)
    if (wanted.contains(wm["subarchitecture"]))
      read(wm["subarchitecture"], "");
  return result;
}

std::string why_nothing_is_tethered(const std::string& where, const std::vector<Json>& entries) {
  if (where.empty())
    return "binding has no unions yet";
  auto types = tethered_types(entries);
  if (types.empty())
    return "no proxy is tethered to anything";
  return fmt::format("no proxy is tethered to {}; proxies are tethered to entries of {}", where,
                     fmt::join(types, ", "));
}

int show_tethers(const TetherArguments& arguments) {
  auto system = choose_system(arguments.system);
  auto entries = tethered_entries(system);
  std::vector<Json> roots;
  if (arguments.where.empty())
    roots = unions_among(entries);
  else
    roots = ask_for_all(system, values_request(arguments.where));
  auto trees = follow_tethers(roots, entries);
  if (trees.empty())
    throw std::runtime_error(why_nothing_is_tethered(arguments.where, entries));
  if (!arguments.json) {
    print(tethers_as_text(trees));
    return success;
  }
  for (auto& x : trees)
    print(x.dump() + '\n');
  return success;
}

} // namespace

void add_wm_tether(CLI::App& wm, Action& chosen) {
  auto arguments = std::make_shared<TetherArguments>();
  auto* command = inspection_command(
    wm, "tether",
    "follow tethers from binding's unions to the entries that they stand for, and back",
    arguments->system);
  add_where_option(*command, arguments->where);
  add_json_flag(*command, arguments->json);
  command->footer("From a union over its proxies to the entries that they stand for, and from such "
                  "an entry to its proxies and\nto the unions that they are in; from every union "
                  "if WHERE is left out.");
  on_call(*command, chosen, arguments, show_tethers);
}

} // namespace castor::cli
