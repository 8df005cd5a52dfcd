#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/running_system.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

struct EventsArguments {
  std::string system;
  bool json = false;
  bool wait = false;
  std::vector<std::string> filter;
};

int events(const EventsArguments& arguments) {
  return print_changes(choose_system(arguments.system),
                       {{"do", "events"},
                        {"filter", change_filter_text(arguments.filter)},
                        {"wait", arguments.wait}},
                       arguments.json);
}

} // namespace

void add_events(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<EventsArguments>();
  auto* command = inspection_command(
    app, "events", "print the change events of a running system as they happen", arguments->system);
  command
    ->add_option("FILTER", arguments->filter,
                 "[added|overwritten|deleted|changed] [TYPE] [in SUBARCHITECTURE] "
                 "[from COMPONENT] [at ID] [changing FIELD,...] [where CONDITION]")
    ->type_name("");
  add_json_flag(*command, arguments->json);
  add_wait_flag(*command, arguments->wait);
  command->footer("Examples: castor events\n"
                  "          castor events overwritten SceneObject in vision changing colour\n"
                  "          castor events added ROI where 'area > 400'\n"
                  "          castor events in mapping at \"tile 3 -1\"\n"
                  "Events are filtered at their source. For a slow reader they are merged.");
  on_call(*command, chosen, arguments, events);
}

} // namespace castor::cli
