#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <string>

namespace castor::cli {

namespace {

struct CallArguments {
  std::string system;
  std::string subarchitecture;
  std::string type;
  std::string request;
  std::string timeout = "5s";
  bool full = false;
  bool json = false;
};

int call(const CallArguments& arguments) {
  auto x =
    ask_for_one(choose_system(arguments.system),
                {{"do", "call"},
                 {"subarchitecture", arguments.subarchitecture},
                 {"type", arguments.type},
                 {"request", read_json(arguments.request)},
                 {"timeout", std::chrono::duration<double>(*duration(arguments.timeout)).count()},
                 {"full", arguments.full}});
  print((arguments.json ? x.dump() : x["value"].dump(2)) + '\n');
  return success;
}

} // namespace

void add_call(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<CallArguments>();
  auto* command = inspection_command(
    app, "call", "send a request to a subarchitecture of a running system", arguments->system);
  command
    ->add_option("SUBARCHITECTURE", arguments->subarchitecture,
                 "subarchitecture that serves such requests; any of its components may reply")
    ->required();
  command->add_option("REQUEST-TYPE", arguments->type, "the type of the request")->required();
  command
    ->add_option("JSON", arguments->request,
                 "the request, with all fields of the type; - reads it from standard input")
    ->required();
  command->add_option("--timeout", arguments->timeout, "how long to wait for the reply")
    ->type_name("DURATION")
    ->check(check_duration)
    ->capture_default_str();
  command->add_flag("--full", arguments->full,
                    "show byte fields of the reply, however long, as base64 text");
  add_json_flag(*command, arguments->json);
  command->footer(
    "This is the call that components make with call<Request, Reply>(). Prints the reply; with\n"
    "--json also who gave it. `castor wm types REQUEST-TYPE` prints an example of a request.\n"
    "Examples: castor call planning MakePlan '{\"goal\": \"the cup is on the table\"}'\n"
    "          castor call kitchen Boil '{\"litres\": 1.5}' --timeout 5min --json");
  on_call(*command, chosen, arguments, call);
}

} // namespace castor::cli
