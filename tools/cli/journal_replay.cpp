#include "castor/tools/cli/journal_replay.hpp"

#include "castor/actors/system/local_endpoint.hpp"
#include "castor/actors/system/replay.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/keys.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/read_architecture.hpp"
#include "castor/tools/cli/replay_source.hpp"
#include "castor/tools/cli/report.hpp"
#include "castor/tools/cli/running_system.hpp"
#include "castor/tools/cli/signals.hpp"
#include "castor/tools/cli/writable.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;

struct JournalReplayArguments {
  std::vector<std::string> places;
  std::string into;
  ArchitectureArguments architecture;
  std::string speed = "1";
  std::vector<std::string> without;
  std::string from;
  std::string to;
  std::optional<std::uint64_t> rounds;
  std::string quiet;
  std::filesystem::path output;
  bool json = false;
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

/// What is to be replayed, and how.
struct Plan {
  ReplaySource source;
  /// Components whose writes are made again; nothing for all.
  std::optional<std::set<std::string>> replayed;
  UnixTime from{0};
  UnixTime to{0};
  double speed = 1;
  std::uint64_t rounds = 1;

  double seconds(UnixTime x) const { return std::chrono::duration<double>(x - from).count(); }

  Json request() const {
    auto names = [](const std::vector<std::filesystem::path>& files) {
      auto result = Json::array();
      for (auto& x : files)
        result.push_back(std::filesystem::absolute(x).string());
      return result;
    };
    Json result{{"do", "replay"},
                {"files", names(source.journals)},
                {"pushes", names(source.pushes)},
                {"speed", speed},
                {"from", from.count()},
                {"to", to.count()},
                {"end", source.end.count()},
                {"rounds", rounds},
                {"progress", true}};
    if (replayed)
      result["sources"] = *replayed;
    return result;
  }
};

Plan plan_of(const JournalReplayArguments& arguments) {
  Plan result;
  result.source = find_replay_source(arguments.places);
  result.speed = speed_of(arguments.speed);
  result.rounds = arguments.rounds.value_or(1);
  auto& source = result.source;
  result.from = source.begin + duration(arguments.from).value_or(0ms);
  if (auto to = duration(arguments.to))
    result.to = source.begin + *to;
  if (result.from > source.end)
    throw std::runtime_error(fmt::format("--from {} is behind the end of the recording, which "
                                         "lasts {:.1f} s",
                                         arguments.from, source.seconds()));
  if (result.to.count() > 0 && result.to <= result.from)
    throw std::runtime_error("--to has to be later than --from");
  return result;
}

/// Throws if the plan comes to nothing, with what there is.
void check_contents(const Plan& plan) {
  auto& contents = plan.source.contents;
  RecordingSelection selection{plan.source.journals, plan.source.pushes, plan.replayed, plan.from};
  Recording recording{selection};
  auto first = recording.next();
  if (first && (plan.to.count() == 0 || time_of(*first) < plan.to))
    return;
  std::string who = "nobody";
  if (plan.replayed)
    who = fmt::format("{}", fmt::join(*plan.replayed, ", "));
  throw std::runtime_error(
    fmt::format("there is nothing to replay{}: the recording lasts {:.1f} s and has {}",
                plan.replayed ? " of " + who
                : first       ? " between --from and --to"
                              : "",
                plan.source.seconds(), in_words(contents)));
}

/// What the user sees and does while it goes on.
class ReplayWatch {
public:
  ReplayWatch(const Plan& plan, std::function<bool()> interrupted)
    : plan_(plan), interrupted_(std::move(interrupted)) {}

  void see(const Json& x) {
    UnixTime at{x["at"].get<std::int64_t>()};
    auto end = plan_.to.count() > 0 && plan_.to < plan_.source.end ? plan_.to : plan_.source.end;
    auto total = plan_.seconds(end);
    auto done = std::clamp(plan_.seconds(at), 0.0, total);
    auto speed = plan_.speed > 0 ? fmt::format("{}x", plan_.speed) : "max";
    auto text = fmt::format("{:.1f} of {:.1f} s, {} writes, speed {}", done, total,
                            x["writes"].get<std::uint64_t>(), speed);
    if (plan_.rounds != 1)
      text += fmt::format(", round {}", x["round"].get<std::uint64_t>());
    if (x["paused"].get<bool>())
      text += ", paused";
    if (keys_.are_read())
      text += " (space: pause, q: quit)";
    progress_.update(done, total, text);
  }

  /// What the user wants to be done.
  std::vector<Json> orders() {
    std::vector<Json> result;
    while (auto key = keys_.next()) {
      if (*key == ' ')
        result.push_back({{"do", std::exchange(paused_, !paused_) ? "go on" : "pause"}});
      else if (*key == 'q')
        result.push_back({{"do", "end"}});
    }
    if (interrupted_() && !std::exchange(ended_, true))
      result.push_back({{"do", "end"}});
    return result;
  }

private:
  const Plan& plan_;
  const std::function<bool()> interrupted_;
  Keys keys_;
  bool paused_ = false;
  bool ended_ = false;
  Progress progress_{"replay"};
};

int print_outcome(const Json& x, bool as_json) {
  if (as_json)
    fmt::print("{}\n", x.dump());
  else
    fmt::print("{} writes replayed, {} skipped because the entry was not there, {} refused{}\n",
               x["writes"].get<std::uint64_t>(), x["skipped"].get<std::uint64_t>(),
               x["refused"].get<std::uint64_t>(),
               x.contains("values")
                 ? fmt::format("; {} values of stand-alone components handed out",
                               x["values"].get<std::uint64_t>())
                 : "");
  if (!x.contains("problem"))
    return success;
  fmt::print(stderr, "castor: {}\n", x["problem"].get<std::string>());
  return bad_input;
}

/// `interrupted` is asked now and then whether it is to end. Nothing if the system ends before.
std::optional<Json> replay_into(const RunningSystem& system, const Plan& plan,
                                std::function<bool()> interrupted) {
  std::optional<Json> outcome;
  ReplayWatch watch{plan, std::move(interrupted)};
  ask(
    system, plan.request(),
    [&](const Json& x) {
      if (x.contains("at"))
        watch.see(x);
      else
        outcome = x;
    },
    [&] { return watch.orders(); });
  return outcome;
}

bool has_components(const ArchitectureDescription& architecture) {
  return !architecture.standalone.empty() ||
         std::ranges::any_of(architecture.subarchitectures,
                             [](auto& x) { return !x.components.empty(); });
}

/// Runs the system of a file, or that of the recording, without those whose writes are replayed.
int replay_into_own(const JournalReplayArguments& arguments, Plan plan,
                    ArchitectureDescription architecture) {
  Signals signals;
  TimeLimit destruction;
  auto& source = plan.source;
  std::set<std::string> left_out;
  if (plan.replayed)
    left_out = *plan.replayed;
  else
    for (auto& [subarchitecture, writers] : source.contents.changes_by)
      for (auto& [writer, changes] : writers)
        left_out.insert(writer);
  prepare_for_replay(architecture, left_out, source.pushes);
  check_contents(plan);
  auto quiet = duration(arguments.quiet.empty() ? source.facts.until_quiet : arguments.quiet);
  if (!arguments.output.empty())
    std::filesystem::create_directories(arguments.output);
  auto somebody_lives = has_components(architecture);
  // So the outcome alone is on standard output.
  std::optional<JsonOutput> json;
  if (arguments.json)
    json.emplace();
  std::atomic<bool> over{false};
  std::atomic<bool> has_ended_before{false};
  SystemOptions options;
  options.endpoint = endpoint_of_process(architecture.file);
  options.interrupted = [&] { return over || signals.count() > 0; };
  std::optional<System> system;
  try {
    system.emplace(std::move(architecture), options);
  } catch (const SystemError& e) {
    print(e.diagnostics());
    return bad_input;
  }
  hand_out_first_values(*system->roster(), source.pushes, plan.from);
  int status = success;
  std::optional<Json> outcome;
  if (system->start()) {
    std::thread replay{[&] {
      try {
        outcome = replay_into({options.endpoint.stem().string(), options.endpoint}, plan,
                              [] { return false; });
      } catch (const std::exception& e) {
        if (!has_ended_before) {
          fmt::print(stderr, "castor: {}\n", e.what());
          status = bad_input;
        }
      }
      over = true;
    }};
    if (somebody_lives)
      system->wait({});
    // A system of working memories alone has nobody who could end it.
    while (!somebody_lives && !options.interrupted())
      std::this_thread::sleep_for(20ms);
    bool finished = over;
    has_ended_before = !finished;
    if (finished) {
      // What the last of it has set off comes to its end.
      over = false;
      system->wait({{}, quiet.value_or(1s)});
    }
    system->stop();
    if (finished && !arguments.output.empty())
      create(arguments.output / "entries.json") << entries_as_json(*system);
    if (!finished) {
      destruction.begin(destruction_limit, a_component_failed);
      system.reset();
      destruction.end();
    }
    replay.join();
  }
  json.reset();
  if (outcome)
    status = std::max(status, print_outcome(*outcome, arguments.json));
  if (!system)
    return status;
  auto summary = system->summary();
  if (!arguments.json)
    fmt::print("\n{}", report(summary));
  if (status == success && has_failed(summary))
    status = a_component_failed;
  destruction.begin(destruction_limit, std::max(status, int{a_component_failed}));
  return status;
}

int replay(const JournalReplayArguments& arguments) {
  auto plan = plan_of(arguments);
  auto& config = arguments.architecture.file;
  if (!arguments.into.empty() && !config.empty())
    throw std::runtime_error("say either --into SYSTEM or --config FILE, not both");
  if (arguments.into.empty() && config.empty() && !plan.source.folder)
    throw std::runtime_error("say where to: --into SYSTEM or --config FILE");
  if (config.empty() && !arguments.architecture.variables.empty())
    throw std::runtime_error("--set is for the file of --config: a recording holds its system as "
                             "it was run, without variables");
  std::optional<ArchitectureDescription> recorded;
  if (plan.source.folder)
    recorded = read_architecture({plan.source.folder->system_file().string(), {}});
  std::optional<ArchitectureDescription> own;
  if (!config.empty() && !(own = read_architecture(arguments.architecture)))
    return bad_input;
  if (!arguments.without.empty()) {
    std::vector<const ArchitectureDescription*> architectures;
    for (auto* x : {&recorded, &own})
      if (*x)
        architectures.push_back(&**x);
    plan.replayed = components_named(arguments.without, plan.source.contents, architectures);
  }
  if (!arguments.into.empty()) {
    Signals signals;
    // The stand-alone components of the running system go on.
    plan.source.pushes.clear();
    check_contents(plan);
    auto outcome =
      replay_into(choose_system(arguments.into), plan, [&] { return signals.count() > 0; });
    if (!outcome)
      throw std::runtime_error(arguments.into + " has ended");
    return print_outcome(*outcome, arguments.json);
  }
  if (!own && !recorded)
    return bad_input;
  return replay_into_own(arguments, std::move(plan), *std::move(own ? own : recorded));
}

} // namespace

void add_journal_replay(CLI::App& journal, Action& chosen) {
  auto arguments = std::make_shared<JournalReplayArguments>();
  auto* command =
    journal.add_subcommand("replay", "replay recorded changes: in the recorded system, in that of "
                                     "a .cast file, or in a running one");
  add_places_argument(*command, arguments->places);
  command
    ->add_option("--into", arguments->into,
                 "running system on this machine; `castor ps` lists them")
    ->type_name("SYSTEM");
  command
    ->add_option("--config", arguments->architecture.file,
                 "run the system of this file, without the components whose writes are replayed; "
                 "by default the recorded system")
    ->type_name("FILE.cast");
  add_set_option(*command, arguments->architecture);
  command
    ->add_option(
      "--without", arguments->without,
      "replay only the writes of these components, and do not run them; a subarchitecture stands "
      "for all its components. All others run, and work on the replayed entries")
    ->type_name("NAME")
    ->delimiter(',');
  command
    ->add_option("--speed", arguments->speed,
                 "1: as recorded, 2: twice as fast, max: as fast as possible")
    ->type_name("N|max");
  command
    ->add_option("--from", arguments->from,
                 "start this far into the recording; entries that existed then are there")
    ->type_name("DURATION")
    ->check(check_duration);
  command->add_option("--to", arguments->to, "end this far into the recording")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option(
      "--loop", arguments->rounds,
      "repeat N times, or until interrupted; entries that were added are removed in between")
    ->type_name("[N]")
    ->expected(0, 1)
    ->default_str("0");
  command
    ->add_option("--until-quiet", arguments->quiet,
                 "after the replay, stop when no entry has changed and no component was busy for "
                 "this long; by default as in the recorded run, or 1s")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option("--output", arguments->output,
                 "write the final entries into this folder (entries.json)")
    ->type_name("DIR")
    ->check(check_output_folder);
  command->add_flag("--json", arguments->json, "print the outcome as JSON, and nothing else");
  command->footer(
    "Without --without, all writes are replayed, and components that have written anything are not "
    "run. Recorded "
    "stand-alone components, such as cameras, are replaced by their recordings. All runs in this "
    "process, and keeps no journals.\n"
    "Changes are made in the name of the component that made them. An entry that is not there is "
    "added, one that is there is overwritten.\n"
    "In a terminal, the space bar pauses and goes on, q ends the replay.\n"
    "Exit status: 1 if a component failed; 2 if there is nothing to replay or a write was "
    "refused.\n"
    "Examples: castor journal replay today --without vision\n"
    "          castor journal replay today --from 20s --to 30s --speed 0.5 --loop\n"
    "          castor journal replay vision.castor-journal --config robot.cast --without camera\n"
    "          castor journal replay journals/*.castor-journal --into robot --speed max");
  on_call(*command, chosen, arguments, replay);
}

} // namespace castor::cli
