#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/pace_option.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <string>

namespace castor::cli {

namespace {

struct ClockArguments {
  std::string system;
  bool json = false;
  /// Of `run`.
  std::string speed;
  /// Of `step`.
  std::string by;
};

int ask_clock(const ClockArguments& arguments, Json request) {
  request["do"] = "clock";
  auto answer = ask_for_one(choose_system(arguments.system), request);
  print((arguments.json ? answer.dump() : clock_as_text(answer)) + '\n');
  return success;
}

int show(const ClockArguments& arguments) {
  return ask_clock(arguments, Json::object());
}

int pause(const ClockArguments& arguments) {
  return ask_clock(arguments, {{"set", "pause"}});
}

int step(const ClockArguments& arguments) {
  return ask_clock(
    arguments,
    {{"set", "step"}, {"seconds", std::chrono::duration<double>(*duration(arguments.by)).count()}});
}

int run(const ClockArguments& arguments) {
  Json request{{"set", "run"}};
  if (auto x = pace(arguments.speed)) {
    if (x->factor)
      request["speed"] = *x->factor;
    else
      request["speed"] = "max";
    if (x->paused)
      request["set"] = "pause";
  }
  return ask_clock(arguments, std::move(request));
}

} // namespace

void add_clock(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
    "clock", "show the clock of a running system, and pause, step or run simulated time");
  command->require_subcommand(1);
  auto arguments = std::make_shared<ClockArguments>();
  auto add = [&](const char* name, const char* help, auto f) {
    auto* result = inspection_command(*command, name, help, arguments->system);
    add_json_flag(*result, arguments->json);
    on_call(*result, chosen, arguments, f);
    return result;
  };
  add("show", "show which time it is, and how fast it goes on", show);
  add("pause", "let simulated time stand", pause);
  add("step", "let some time pass, and pause again", step)
    ->add_option("DURATION", arguments->by, "how much time passes")
    ->type_name("")
    ->required()
    ->check(check_duration);
  add("run", "let simulated time go on", run)
    ->add_option("--speed", arguments->speed, "seconds per second of real time, or max")
    ->type_name("FACTOR|max")
    ->check(check_pace);
  command->footer("The clock can be set if the system was started with `castor run --speed`.\n"
                  "Examples: castor clock show\n"
                  "          castor clock pause\n"
                  "          castor clock step 100ms\n"
                  "          castor clock run --speed 2");
}

} // namespace castor::cli
