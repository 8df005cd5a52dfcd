#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

struct PsArguments {
  std::string system;
  bool json = false;
  bool stats = false;
};

int ps(const PsArguments& arguments) {
  std::vector<RunningSystem> systems;
  if (arguments.system.empty())
    systems = running_systems();
  if (systems.empty())
    systems.push_back(choose_system(arguments.system));
  const char* separator = "";
  for (auto& x : systems) {
    auto report = ask_for_one(x, {{"do", "ps"}});
    print(arguments.json ? report.dump() + '\n'
                         : separator + system_as_text(report, arguments.stats));
    separator = "\n";
  }
  return success;
}

} // namespace

void add_ps(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<PsArguments>();
  auto* command = inspection_command(
    app, "ps", "show running systems: nodes, components, working memories", arguments->system);
  add_json_flag(*command, arguments->json);
  command->add_flag("--stats", arguments->stats, "show counters of change events and of links");
  command->footer("Load is the average share of a processor since the start; busy is how long a "
                  "component has been working without a pause.\n"
                  "Example: castor ps --stats");
  on_call(*command, chosen, arguments, ps);
}

} // namespace castor::cli
