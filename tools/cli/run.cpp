#include "castor/actors/component/option.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/system/inspection_json.hpp"
#include "castor/actors/system/local_endpoint.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/local_nodes.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/pace_option.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/read_architecture.hpp"
#include "castor/tools/cli/record.hpp"
#include "castor/tools/cli/report.hpp"
#include "castor/tools/cli/signals.hpp"
#include "castor/tools/cli/timeline.hpp"
#include "castor/tools/cli/timeline_files.hpp"
#include "castor/tools/cli/writable.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::cli {

namespace {

struct RunArguments {
  ArchitectureArguments architecture;
  RecordArguments record;
  std::string at_most;
  std::string quiet;
  std::string speed;
  bool reproducible = false;
  std::filesystem::path output;
  std::vector<std::string> timelines;
  std::string timeline_gap;
  timeline::StageOptions stages;
  bool trace = false;
  bool open_access = false;
  bool broadcast = false;
  bool no_restarts = false;
  std::vector<std::string> nodes;
  bool local_nodes = false;
  std::string lost_after;
  int spread = 0;
  std::string tls;
  bool insecure = false;
  bool verbose = false;
  bool json = false;
};

/// Prints and writes the timeline; used by one thread at a time.
class Timeline {
public:
  /// @param json where events are printed as JSON; null to print them as text
  Timeline(const RunArguments& arguments, JsonOutput* json)
    : print_(arguments.trace), coloured_(isatty(STDOUT_FILENO) != 0), json_(json) {
    if (!arguments.output.empty()) {
      file_ = create(arguments.output / "timeline.txt");
      file_ << timeline_head(false) << '\n';
    }
    if (print_ && !json_)
      std::puts(timeline_head(coloured_).c_str());
  }

  bool wanted() const { return print_ || file_.is_open(); }

  template <class Event>
  void add(const Event& event) {
    if (print_ && json_) {
      json_->print(to_json(event));
    } else if (print_) {
      const ProgressPause pause;
      std::puts(timeline_line(event, coloured_).c_str());
      // In a pipe too, the reader sees a line when it happens.
      std::fflush(stdout);
    }
    if (file_.is_open())
      file_ << timeline_line(event, false) << '\n';
  }

  void close() { file_.close(); }

private:
  bool print_;
  bool coloured_;
  JsonOutput* json_;
  std::ofstream file_;
};

std::string_view to_string(EndReason x) {
  switch (x) {
    case EndReason::ended_by_component:
      return "component";
    case EndReason::time_over:
      return "time";
    case EndReason::quiet:
      return "quiet";
    case EndReason::interrupted:
      return "interrupted";
    case EndReason::all_failed:
      return "failed";
  }
  return {};
}

/// All that is said of a run when it is over, as JSON or as text.
class RunReport {
public:
  explicit RunReport(JsonOutput* json) : json_(json) {}

  void add(const SystemSummary& summary, const SystemRoster& roster) {
    if (!json_) {
      fmt::print("\n{}", report(summary));
      return;
    }
    result_.update(to_json(summary, roster));
    auto& failures = result_["failures"] = Json::array();
    for (auto& x : summary.components)
      if (!x.failure.empty())
        failures.push_back({{"component", x.identity.full_name()}, {"failure", x.failure}});
    result_["stuck"] = summary.stuck;
  }

  void add_files(const std::vector<std::string>& names) {
    if (!json_)
      fmt::print("\nwrote {}\n", fmt::join(names, ", "));
    for (auto& x : names)
      files_.push_back(x);
  }

  void add(const FinishedRecording& x) {
    if (!json_)
      fmt::print("\n{}", in_words(x));
    recording_ = to_json(x);
  }

  /// The last of it.
  void finish(EndReason why, const std::string& reason, int status) {
    if (!json_)
      return;
    Json line{{"ended", to_string(why)}, {"reason", reason}, {"status", status}};
    line.update(result_);
    line["wrote"] = files_;
    if (!recording_.is_null())
      line["recording"] = recording_;
    json_->print(line);
  }

private:
  JsonOutput* json_;
  Json result_ = Json::object();
  Json files_ = Json::array();
  Json recording_;
};

/// Of HOST=ADDRESS[:PORT], by the addresses of the file.
std::map<std::string, Endpoint> node_addresses(const RunArguments& arguments,
                                               const ArchitectureDescription& architecture) {
  std::map<std::string, Endpoint> result;
  for (auto& x : arguments.nodes) {
    auto sign = x.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == x.size())
      throw std::invalid_argument("write --node HOST=ADDRESS:PORT, not " + x);
    auto host = host_called(architecture, x.substr(0, sign));
    auto at = parse_endpoint(x.substr(sign + 1), default_node_port);
    if (!result.emplace(host, std::move(at)).second)
      throw std::invalid_argument("--node says twice where " + x.substr(0, sign) +
                                  " is; leave one of them out");
  }
  return result;
}

/// The names of the nodes that have to be reached.
std::string nodes_of(const ArchitectureDescription& architecture) {
  std::string result;
  for (auto& [host, name] : other_hosts(architecture))
    result += (result.empty() ? "" : ", ") + name;
  return result;
}

int run(RunArguments arguments, const std::vector<std::string>& plugins) {
  Signals signals;
  TimeLimit destruction;
  std::optional<JsonOutput> json;
  if (arguments.json)
    json.emplace();
  auto* json_output = json ? &*json : nullptr;
  if (!arguments.output.empty()) {
    make_folder(arguments.output);
    arguments.architecture.offered["output"] = arguments.output.string();
  }
  if (arguments.verbose)
    set_log_level(LogLevel::debug);
  auto architecture = read_architecture(arguments.architecture);
  if (!architecture)
    return bad_input;
  Timeline timeline{arguments, json_output};
  SystemOptions options;
  options.open_access = arguments.open_access;
  options.broadcast = arguments.broadcast;
  options.restarts = !arguments.no_restarts;
  options.clock.pace = pace(arguments.speed);
  options.clock.reproducible = arguments.reproducible;
  if (arguments.reproducible && !options.clock.pace)
    options.clock.pace = Pace{};
  if (timeline.wanted()) {
    options.on_change = [&](const ChangeEvent& event) { timeline.add(event); };
    options.on_task = [&](const TaskEvent& event) { timeline.add(event); };
  }
  std::optional<TimelineFiles> picture;
  if (!arguments.timelines.empty()) {
    if (auto gap = duration(arguments.timeline_gap))
      arguments.stages.gap = std::chrono::duration_cast<Timestamp>(*gap);
    picture.emplace(arguments.stages);
    picture->watch(options);
  }
  options.interrupted = [&] { return signals.count() > 0; };
  options.insecure = arguments.insecure;
  options.link.patience = duration(arguments.lost_after).value_or(options.link.patience);
  if (!arguments.tls.empty())
    options.credentials = Credentials::load(
      arguments.local_nodes || arguments.spread > 0 ? arguments.tls + "/run" : arguments.tls);
  if (arguments.spread > 0)
    spread(*architecture, arguments.spread);
  options.nodes = node_addresses(arguments, *architecture);
  apply_journal_arguments(arguments.record, *architecture);
  std::optional<RunRecording> recording;
  if (!arguments.record.folder.empty())
    recording.emplace(arguments.record, arguments.architecture, arguments.quiet, *architecture,
                      options, arguments.local_nodes || arguments.spread > 0);
  std::optional<Progress> progress{std::in_place, "starting"};
  progress->update("processes of this machine, and component classes");
  // They outlive the system, which says goodbye to them.
  auto local_nodes = start_local_nodes(*architecture, arguments.local_nodes || arguments.spread > 0,
                                       plugins, arguments.tls, options);
  try {
    options.endpoint = endpoint_of_process(architecture->file);
  } catch (const std::runtime_error& e) {
    log_runtime(LogLevel::warning,
                std::string{"`castor ps` will not find the system: "} + e.what());
  }
  auto title = std::filesystem::path{architecture->file}.filename().string();
  std::unique_ptr<System> system;
  bool was_started = false;
  try {
    if (auto nodes = nodes_of(*architecture); !nodes.empty())
      progress->update("waiting for nodes: " + nodes);
    system = std::make_unique<System>(std::move(*architecture), options);
    progress->update("components configure themselves and start");
    if (picture)
      picture->look_at_beginning(*system);
    was_started = system->start();
    progress.reset();
  } catch (const SystemError& e) {
    destruction.begin(destruction_limit, bad_input);
    system.reset();
    progress.reset();
    print(e.diagnostics());
    return bad_input;
  }
  int status = success;
  std::string why_ended;
  auto reason = EndReason::interrupted;
  if (was_started)
    reason = system->wait({duration(arguments.at_most), duration(arguments.quiet)});
  if (reason == EndReason::interrupted)
    log_runtime(LogLevel::info, signals.has_output_ended()
                                  ? "nobody reads the output any more: stopping"
                                  : "interrupted: stopping (interrupt again to end at once)");
  if (auto ended = system->ended()) {
    status = ended->first;
    why_ended = ended->second;
    log_runtime(LogLevel::info, "ended by " + ended->second);
  }
  if (picture)
    picture->end(*system);
  if (local_nodes)
    local_nodes->end_restarts();
  system->stop();
  const auto lasted = system->now();
  timeline.close();
  auto summary = system->summary();
  RunReport run_report{json_output};
  run_report.add(summary, *system->roster());
  if (!arguments.output.empty()) {
    create(arguments.output / "entries.json") << entries_as_json(*system);
    run_report.add_files({arguments.output.string()});
  }
  if (picture) {
    picture->write(arguments.timelines, title, system->subarchitectures());
    run_report.add_files(arguments.timelines);
  }
  if (status == success && has_failed(summary))
    status = a_component_failed;
  if (!summary.stuck.empty()) {
    // Their threads cannot be ended, and destroying the system would wait for them.
    system->abandon();
    local_nodes.reset();
    run_report.finish(reason, why_ended, status);
    flush_log();
    std::fflush(stdout);
    std::_Exit(status);
  }
  destruction.begin(recording ? recording_limit : destruction_limit, a_component_failed);
  system.reset();
  local_nodes.reset();
  destruction.end();
  // What still waited to be written has been when they are gone.
  if (recording)
    run_report.add(recording->finish(plugins, lasted));
  run_report.finish(reason, why_ended, status);
  return status;
}

} // namespace

void add_run(CLI::App& app, Action& chosen, const std::vector<std::string>& plugins) {
  auto* command = app.add_subcommand("run", "run the system that a .cast file describes");
  auto arguments = std::make_shared<RunArguments>();
  add_architecture_arguments(*command, arguments->architecture);
  command->add_option("--for", arguments->at_most, "stop after so long")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option("--until-quiet", arguments->quiet,
                 "stop when no entry has changed and no component was busy, has failed or was "
                 "restarted for this long")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option(
      "--speed", arguments->speed,
      "simulate time: seconds per second of real time, `max` for as fast as all "
      "components are done, or `paused`; --for and --until-quiet are simulated time then")
    ->type_name("FACTOR|max|paused")
    ->check(check_pace);
  command->add_flag("--reproducible", arguments->reproducible,
                    "simulate time, and let components run one at a time, so that each run has the "
                    "same result; as fast as possible without --speed; in one process only");
  command
    ->add_option("--output", arguments->output,
                 "folder for the timeline, the entries and files that components write; in the "
                 ".cast file it is %(output)")
    ->type_name("DIR")
    ->check(check_output_folder);
  command
    ->add_option("--timeline", arguments->timelines,
                 "draw the contents of the working memories, stage by stage, after the run: as a "
                 "page (.html) or as a picture (.svg, .png) (repeatable)")
    ->type_name("FILE")
    ->take_all()
    ->check(check_timeline_file);
  command
    ->add_option(
      "--timeline-gap", arguments->timeline_gap,
      "a stage of the timeline ends when nothing has happened for this long; by default 250ms")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option("--timeline-stages", arguments->stages.most,
                 "maximum number of stages: those with the shortest pauses between them are merged")
    ->type_name("N")
    ->check(CLI::Range(1, 100))
    ->capture_default_str();
  add_record_arguments(*command, arguments->record);
  command->add_flag("--trace", arguments->trace,
                    "print every change event of every working memory, and every task event");
  command->add_flag("--open-access", arguments->open_access,
                    "let every subarchitecture write to every other, as the original CAST does");
  command->add_flag("--broadcast", arguments->broadcast,
                    "send every change event to every working memory, as the original CAST did "
                    "before it filtered: to measure what filtering saves");
  command->add_flag(
    "--no-restarts", arguments->no_restarts,
    "do not restart failed components, whatever the file says: to see what went wrong");
  command
    ->add_option(
      "--node", arguments->nodes,
      "address of the node of a host in the .cast file, whatever the file says (repeatable)")
    ->type_name("HOST=ADDRESS:PORT")
    ->take_all();
  command->add_flag("--local-nodes", arguments->local_nodes,
                    "start all nodes on this machine, to try a distributed system");
  command
    ->add_option("--lost-after", arguments->lost_after,
                 "a node that is unreachable for this long is lost: its components fail over, or "
                 "wait for a new node in its place; by default 30s")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option("--spread", arguments->spread,
                 "distribute the system over N nodes on this machine, whatever hosts the file "
                 "names, to check that no component depends on where it runs")
    ->type_name("N")
    ->check(CLI::Range(1, 100));
  command
    ->add_option("--tls", arguments->tls,
                 "encrypt and authenticate connections to nodes with ca.pem, node.pem and "
                 "node.key of this folder (scripts/make-certs makes them); with --local-nodes the "
                 "folder of such folders, one for each node and one of the name `run`")
    ->type_name("DIR");
  command->add_flag("--insecure", arguments->insecure,
                    "without --tls, connect to nodes on other machines and of other users");
  command->add_flag("--json", arguments->json,
                    "print JSON, one object on a line: changes and tasks with --trace, at the end "
                    "how the run ended; what components print goes to standard error");
  command->add_flag("-v,--verbose", arguments->verbose, "log in more detail");
  command->footer(
    "Ctrl-C stops the components in the reverse order of their start.\n"
    "Exit status: that of the component that ended the system, otherwise 0; 1 if a component "
    "failed; 2 if the system could not be started.\n"
    "Examples: castor run configs/vision.cast --trace --until-quiet 2s --output out\n"
    "          castor run configs/playmate.cast --set typed=true --record today");
  command->callback([&chosen, &plugins, arguments] {
    chosen = [&plugins, arguments] { return run(*arguments, plugins); };
  });
}

} // namespace castor::cli
