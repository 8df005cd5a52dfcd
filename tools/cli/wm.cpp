#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

struct WmArguments {
  std::string system;
  bool json = false;
  bool full = false;
  bool wait = false;
  /// SUBARCHITECTURE[/ID|TYPE]
  std::string where;
};

/// The types are known, or the system would have refused the request.
void say_if_empty(const std::vector<Json>& entries, const WmArguments& arguments) {
  if (entries.empty())
    fmt::print(stderr, "there are no entries of {}\n", arguments.where);
}

void print_entries(const std::vector<Json>& entries, const WmArguments& arguments) {
  if (!arguments.json) {
    print(entries_as_text(entries));
    return;
  }
  for (auto& x : entries)
    print(x.dump() + '\n');
}

int list_entries(const WmArguments& arguments) {
  auto system = choose_system(arguments.system);
  if (!arguments.where.empty()) {
    auto entries = ask_for_all(system, entries_request(arguments.where));
    say_if_empty(entries, arguments);
    print_entries(entries, arguments);
    return success;
  }
  std::vector<Json> entries;
  auto report = ask_for_one(system, {{"do", "ps"}});
  for (auto& wm : report["working_memories"])
    for (auto& x : ask_for_all(system, {{"do", "wm"}, {"subarchitecture", wm["subarchitecture"]}}))
      entries.push_back(x);
  print_entries(entries, arguments);
  return success;
}

int get_entries(const WmArguments& arguments) {
  auto system = choose_system(arguments.system);
  auto entries = ask_for_all(system, values_request(arguments.where, arguments.full));
  say_if_empty(entries, arguments);
  for (auto& x : entries)
    print((arguments.json ? x.dump() : x["value"].dump(2)) + '\n');
  return success;
}

int watch_entries(const WmArguments& arguments) {
  auto request = values_request(arguments.where, arguments.full);
  request["do"] = "events";
  request["wait"] = arguments.wait;
  request["filter"] = "in " + request["subarchitecture"].get<std::string>();
  return print_changes(choose_system(arguments.system), request, arguments.json);
}

CLI::App* entry_command(CLI::App& wm, const std::string& name, const std::string& help,
                        const std::shared_ptr<WmArguments>& arguments) {
  auto* result = inspection_command(wm, name, help, arguments->system);
  add_where_option(*result, arguments->where);
  add_json_flag(*result, arguments->json);
  return result;
}

void add_full_flag(CLI::App& command, WmArguments& arguments) {
  command.add_flag("--full", arguments.full, "show byte fields, however long, as base64 text");
}

} // namespace

void add_wm(CLI::App& app, Action& chosen) {
  auto* wm = app.add_subcommand("wm", "read and change the working memories of a running system");
  wm->require_subcommand(1);
  auto arguments = std::make_shared<WmArguments>();
  auto* ls = entry_command(*wm, "ls", "list entries", arguments);
  on_call(*ls, chosen, arguments, list_entries);
  auto* get = entry_command(*wm, "get", "print the values of entries", arguments);
  get->get_option("WHERE")->required();
  add_full_flag(*get, *arguments);
  on_call(*get, chosen, arguments, get_entries);
  auto* watch =
    entry_command(*wm, "watch", "print changes with the new values, as they happen", arguments);
  watch->get_option("WHERE")->required();
  add_full_flag(*watch, *arguments);
  add_wait_flag(*watch, arguments->wait);
  on_call(*watch, chosen, arguments, watch_entries);
  add_wm_tether(*wm, chosen);
  add_wm_writes(*wm, chosen);
  wm->footer("Examples: castor wm ls\n"
             "          castor wm get vision/SceneObject\n"
             "          castor wm types SceneObject\n"
             "          castor wm add kitchen Order '{\"dish\": \"soup\", \"table\": 4}'\n"
             "          castor wm overwrite kitchen/order7 --merge '{\"table\": 5}'\n"
             "          castor wm delete kitchen/order7\n"
             "          castor wm watch vision/0:3 --json\n"
             "          castor wm tether vision/0:3");
}

} // namespace castor::cli
