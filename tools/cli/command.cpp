#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <tuple>

namespace castor::cli {

namespace {

struct CommandArguments {
  std::string system;
  std::string effector;
  std::string type;
  std::string command;
  std::string duration;
  std::string valid_for;
  bool json = false;
};

int send_command(const CommandArguments& arguments) {
  Json request{{"do", "command"},
               {"effector", arguments.effector},
               {"type", arguments.type},
               {"command", read_json(arguments.command)}};
  auto add_seconds = [&](const char* name, const std::string& text) {
    if (!text.empty())
      request[name] = std::chrono::duration<double>(*duration(text)).count();
  };
  add_seconds("for", arguments.duration);
  add_seconds("valid_for", arguments.valid_for);
  auto x = ask_for_one(choose_system(arguments.system), request);
  auto times = x.at("commands").get<std::uint64_t>();
  print(arguments.json
          ? x.dump() + '\n'
          : fmt::format("{} has obeyed{}. It takes its safe state now.\n", arguments.effector,
                        times == 1 ? "" : fmt::format(" {} times", times)));
  return success;
}

} // namespace

void add_command(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<CommandArguments>();
  auto* command_line = inspection_command(app, "command", "command an effector of a running system",
                                          arguments->system);
  command_line
    ->add_option("NAME", arguments->effector,
                 "stand-alone component that obeys such commands; castor ps lists all")
    ->required();
  command_line->add_option("TYPE", arguments->type, "type of the command")->required();
  command_line
    ->add_option("JSON", arguments->command,
                 "the command, with all fields of the type; - reads it from standard input")
    ->required();
  for (auto [name, value, help] :
       {std::tuple{"--for", &arguments->duration, "command it again and again for this long"},
        std::tuple{"--valid-for", &arguments->valid_for,
                   "how long each command holds; the effector's maximum by default"}})
    command_line->add_option(name, *value, help)->type_name("DURATION")->check(check_duration);
  add_json_flag(*command_line, arguments->json);
  command_line->footer(
    "Takes the lease that the effector demands, commands, and ends when the command expires; the\n"
    "effector then takes its safe state. So it does at once on Ctrl-C, and if this process is\n"
    "killed. If another component holds the lease, nothing is commanded.\n"
    "`castor wm types TYPE` prints an example of a command.\n"
    "Examples: castor command wheel Turn '{\"speed\": 0.2}'\n"
    "          castor command wheel Turn '{\"speed\": 0.2}' --for 3s");
  on_call(*command_line, chosen, arguments, send_command);
}

} // namespace castor::cli
