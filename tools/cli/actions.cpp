#include "castor/actors/component/action_types.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

struct ActionsArguments {
  std::string system;
  bool json = false;
};

/// The entries of that type in all working memories, with their values.
std::vector<Json> entries_of_type(const RunningSystem& system, const Json& report,
                                  const std::string& type) {
  std::vector<Json> result;
  for (auto& wm : report["working_memories"])
    if (wm["entries_by_type"].contains(type))
      for (auto& x : ask_for_all(system, {{"do", "wm"},
                                          {"subarchitecture", wm["subarchitecture"]},
                                          {"what", type},
                                          {"values", true}}))
        result.push_back(x);
  return result;
}

int list_actions(const ActionsArguments& arguments) {
  auto system = choose_system(arguments.system);
  auto report = ask_for_one(system, {{"do", "ps"}});
  auto actions = entries_of_type(system, report, type_name<castor::Action>());
  auto offers = entries_of_type(system, report, type_name<ActionRegistration>());
  if (!arguments.json) {
    print(actions_as_text(actions, offers));
    return success;
  }
  for (auto* list : {&actions, &offers})
    for (auto& x : *list)
      print(x.dump() + '\n');
  return success;
}

} // namespace

void add_actions(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<ActionsArguments>();
  auto* command = inspection_command(
    app, "actions", "list the actions of a running system, and those that are offered",
    arguments->system);
  add_json_flag(*command, arguments->json);
  command->footer(
    "An action that is over is listed until its requester has no more interest in it, at most for "
    "ten minutes.\n"
    "Example: castor actions --json");
  on_call(*command, chosen, arguments, list_actions);
}

} // namespace castor::cli
