#include "castor/actors/cli/journal_replay.hpp"

#include "castor/actors/cli/output.hpp"
#include "castor/actors/cli/read_architecture.hpp"
#include "castor/actors/cli/report.hpp"
#include "castor/actors/cli/running_system.hpp"
#include "castor/actors/cli/signals.hpp"
#include "castor/actors/node/local_endpoint.hpp"
#include "castor/actors/node/recording.hpp"
#include "castor/actors/node/system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;

struct Arguments {
  std::vector<std::string> files;
  std::string into;
  ArchitectureArguments architecture;
  std::string speed = "1";
  std::vector<std::string> without;
};

/// 0 for as fast as it can be.
double speed_of(const std::string& text) {
  if (text == "max")
    return 0;
  std::size_t end = 0;
  double result = 0;
  try {
    result = std::stod(text, &end);
  } catch (const std::logic_error&) {
    end = 0;
  }
  if (end != text.size() || !(result > 0))
    throw std::runtime_error("write --speed 1, --speed 0.5, --speed 10 or --speed max, not " +
                             text);
  return result;
}

/// Who has written the recording.
std::set<std::string> writers_of(const std::vector<std::string>& files) {
  Recording recording{{files.begin(), files.end()}, {}};
  std::set<std::string> result;
  while (auto write = recording.next())
    result.insert(write->source);
  return result;
}

/// Takes these components out of the system, for the recording stands in for them.
void leave_out(ArchitectureDescription& architecture, const std::set<std::string>& names) {
  auto is_one = [&](const ComponentDescription& x) { return names.count(x.name) > 0; };
  for (auto& x : architecture.subarchitectures)
    std::erase_if(x.components, is_one);
  std::erase_if(architecture.standalone, is_one);
}

int print_outcome(const Json& x) {
  fmt::print("{} writes replayed, {} skipped because the entry was not there, {} refused\n",
             x["writes"].get<std::uint64_t>(), x["skipped"].get<std::uint64_t>(),
             x["refused"].get<std::uint64_t>());
  if (!x.contains("problem"))
    return success;
  fmt::print(stderr, "{}\n", x["problem"].get<std::string>());
  return bad_input;
}

int replay_into(const RunningSystem& system, const Json& request) {
  int status = success;
  ask(system, request, [&](const Json& x) { status = print_outcome(x); });
  return status;
}

/// Runs the system of a file, without those whose writes are replayed.
int replay_into_own(const Arguments& arguments, const Json& request,
                    const std::set<std::string>& replayed) {
  Signals signals;
  auto architecture = read_architecture(arguments.architecture);
  if (!architecture)
    return bad_input;
  leave_out(*architecture, replayed);
  std::atomic<bool> over{false};
  SystemOptions options;
  options.endpoint = endpoint_of_process(architecture->file);
  options.interrupted = [&] { return over || signals.count() > 0; };
  std::optional<System> system;
  try {
    system.emplace(std::move(*architecture), options);
  } catch (const SystemError& e) {
    print(e.diagnostics());
    return bad_input;
  }
  int status = success;
  if (system->start()) {
    std::thread replay{[&] {
      try {
        status = replay_into({options.endpoint.stem().string(), options.endpoint}, request);
      } catch (const std::exception& e) {
        fmt::print(stderr, "castor: {}\n", e.what());
        status = bad_input;
      }
      over = true;
    }};
    system->wait({});
    bool finished = over;
    if (finished) {
      // What the last of it has set off comes to its end.
      over = false;
      system->wait({{}, 1s});
    }
    system->stop();
    if (!finished)
      system.reset();
    replay.join();
  }
  if (system) {
    auto summary = system->summary();
    fmt::print("\n{}", report(summary));
  }
  return status;
}

int replay(const Arguments& arguments) {
  if (arguments.into.empty() == arguments.architecture.file.empty())
    throw std::runtime_error("say where to: --into SYSTEM or --config FILE");
  std::set<std::string> replayed{arguments.without.begin(), arguments.without.end()};
  auto files = Json::array();
  for (auto& x : arguments.files)
    files.push_back(std::filesystem::absolute(x).string());
  Json request{{"do", "replay"},
               {"files", files},
               {"sources", replayed},
               {"speed", speed_of(arguments.speed)}};
  if (!arguments.into.empty())
    return replay_into(choose_system(arguments.into), request);
  return replay_into_own(arguments, request,
                         replayed.empty() ? writers_of(arguments.files) : replayed);
}

} // namespace

void add_journal_replay(CLI::App& journal, Action& chosen) {
  auto arguments = std::make_shared<Arguments>();
  auto* command =
    journal.add_subcommand("replay", "make the recorded changes again, in a running system or in "
                                     "that of a .cast file");
  command->add_option("FILE", arguments->files, "the journals, of one system")
    ->required()
    ->type_name("");
  command
    ->add_option("--into", arguments->into,
                 "a system that runs on this machine; `castor ps` shows them")
    ->type_name("SYSTEM");
  command
    ->add_option("--config", arguments->architecture.file,
                 "run the system of this file meanwhile, without those whose writes are replayed")
    ->type_name("FILE.cast");
  command
    ->add_option("--set", arguments->architecture.variables,
                 "give a variable of the file a value (repeatable)")
    ->type_name("NAME=VALUE")
    ->take_all();
  command
    ->add_option("--speed", arguments->speed,
                 "1 is as it was, 2 is twice as fast; max is as fast as can be")
    ->type_name("N|max");
  command
    ->add_option("--without", arguments->without,
                 "replay the writes of these components only, and leave only them out: they are "
                 "the sensors, and all others work on what is replayed")
    ->type_name("COMPONENT")
    ->delimiter(',');
  command->footer(
    "Without --without everything is replayed, and of --config nobody runs who has written "
    "anything.\n"
    "Changes are made in the name of the component that made them. An entry that is not there is "
    "added, one that is there is overwritten.\n"
    "Examples: castor journal replay journals/vision.castor-journal --config robot.cast "
    "--without camera\n"
    "          castor journal replay journals/*.castor-journal --into robot --speed max");
  command->callback([&chosen, arguments] { chosen = [arguments] { return replay(*arguments); }; });
}

} // namespace castor::cli
