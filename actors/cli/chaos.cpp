#include "castor/actors/cli/commands.hpp"
#include "castor/actors/cli/duration_option.hpp"
#include "castor/actors/cli/final_state.hpp"
#include "castor/actors/cli/history_watch.hpp"
#include "castor/actors/cli/inspection_command.hpp"
#include "castor/actors/cli/local_nodes.hpp"
#include "castor/actors/cli/output.hpp"
#include "castor/actors/cli/process_resources.hpp"
#include "castor/actors/cli/progress.hpp"
#include "castor/actors/cli/read_architecture.hpp"
#include "castor/actors/cli/read_plan.hpp"
#include "castor/actors/cli/signals.hpp"
#include "castor/actors/cli/writable.hpp"
#include "castor/actors/component/log.hpp"
#include "castor/actors/faults/chaos_report.hpp"
#include "castor/actors/faults/injector.hpp"
#include "castor/actors/faults/outages.hpp"
#include "castor/actors/faults/random_plan.hpp"
#include "castor/actors/faults/resource_growth.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Arguments {
  ArchitectureArguments architecture;
  std::string plan;
  std::optional<std::uint64_t> seed;
  std::string duration = "1min";
  std::filesystem::path report;
  int spread = 0;
  std::vector<std::string> same;
  std::vector<std::string> but_for;
  std::string settle = "2s";
  std::string bound = "10s";
  bool json = false;
};

/// What has been noticed of components, by one thread while another looks.
class Notes {
public:
  explicit Notes(Clock::time_point begin) : begin_(begin) {}

  void add(const std::string& who, faults::LifeNote::Kind kind, const std::string& reason) {
    std::lock_guard guard{mutex_};
    notes_.push_back({now(), who, kind, reason});
    if (kind == faults::LifeNote::Kind::up)
      down_.erase(who);
    else
      down_.insert(who);
  }

  /// How many components are down just now.
  std::size_t down() const {
    std::lock_guard guard{mutex_};
    return down_.size();
  }

  std::vector<faults::LifeNote> all() const {
    std::lock_guard guard{mutex_};
    return notes_;
  }

private:
  Timestamp now() const { return std::chrono::duration_cast<Timestamp>(Clock::now() - begin_); }

  const Clock::time_point begin_;
  mutable std::mutex mutex_;
  std::vector<faults::LifeNote> notes_;
  std::set<std::string> down_;
};

/// A run of `castor chaos`, step by step.
class Chaos {
public:
  Chaos(const Arguments& arguments, const std::vector<std::string>& plugins)
    : arguments_(arguments), plugins_(plugins), duration_(duration(arguments.duration).value()),
      settle_(duration(arguments.settle).value()), question_{
                                                     {arguments.same.begin(), arguments.same.end()},
                                                     {arguments.but_for.begin(),
                                                      arguments.but_for.end()}} {}

  int run() {
    if (arguments_.json)
      json_.emplace();
    auto architecture = read_architecture(arguments_.architecture);
    if (!architecture)
      return bad_input;
    if (arguments_.spread > 0)
      spread(*architecture, arguments_.spread);
    if (!take_plan(*architecture))
      return bad_input;
    result_.system = arguments_.architecture.file;
    result_.command = command();
    result_.seed = seed_;
    result_.duration = duration_;
    progress_.emplace("chaos");
    if (!question_.types.empty()) {
      note(LogLevel::info, "first without faults, to see how it ends then");
      show_step("starting the system without faults");
      wanted_ = run_in_peace(*architecture);
      if (signals_.count() > 0)
        return a_component_failed;
    }
    run_with_faults(*architecture);
    return finish();
  }

private:
  /// Of the user's plan, or a random one; false if it cannot be brought about.
  bool take_plan(const ArchitectureDescription& architecture) {
    targets_ = targets_in(architecture);
    if (!arguments_.plan.empty()) {
      auto plan = read_plan(arguments_.plan, targets_);
      if (!plan)
        return false;
      plan_ = *std::move(plan);
    }
    seed_ = arguments_.seed.value_or(plan_.seed.value_or(new_incarnation() % 1'000'000));
    if (!arguments_.plan.empty())
      return true;
    plan_ = faults::random_plan(targets_, seed_, duration_);
    return is_possible(plan_, targets_);
  }

  /// What makes the same faults once more.
  std::string command() const {
    std::string result = "castor";
    for (auto& x : plugins_)
      result += " --plugin " + x;
    result += " chaos " + arguments_.architecture.file;
    if (!arguments_.plan.empty())
      result += " --plan " + arguments_.plan;
    result += fmt::format(" --seed {} --duration {}", seed_, arguments_.duration);
    if (arguments_.spread > 0)
      result += fmt::format(" --spread {}", arguments_.spread);
    for (auto& x : arguments_.architecture.variables)
      result += " --set " + x;
    for (auto& x : arguments_.same)
      result += " --same " + x;
    for (auto& x : arguments_.but_for)
      result += " --but-for " + x;
    for (auto& [option, value, otherwise] :
         {std::tuple{"settle", arguments_.settle, Arguments{}.settle},
          std::tuple{"bound", arguments_.bound, Arguments{}.bound}})
      if (value != otherwise)
        result += fmt::format(" --{} {}", option, value);
    return result;
  }

  SystemOptions options() {
    SystemOptions result;
    result.interrupted = [this] {
      show_faults();
      return signals_.count() > 0;
    };
    return result;
  }

  /// How far the faults are, if they are under way.
  void show_faults() {
    if (!progress_->due())
      return;
    std::lock_guard guard{progress_mutex_};
    if (faults_so_far_)
      faults_so_far_();
  }

  void show_faults_with(std::function<void()> f) {
    std::lock_guard guard{progress_mutex_};
    faults_so_far_ = std::move(f);
  }

  /// What takes its time now, nobody knows how much.
  void show_step(const std::string& what) { progress_->update(0, {}, what); }

  /// Lets the system come to rest, and takes its state.
  std::vector<std::string> come_to_rest(System& system) {
    show_step("waiting until nothing changes any more");
    auto reason = system.wait({60s, settle_});
    if (reason == EndReason::time_over)
      violation("rest", "the system did not come to rest within 60 s");
    return state_of(system, question_);
  }

  std::vector<std::string> run_in_peace(ArchitectureDescription architecture) {
    TimeLimit destruction;
    auto options = this->options();
    auto nodes = start_local_nodes(architecture, true, plugins_, {}, options);
    System system{std::move(architecture), options};
    std::vector<std::string> result;
    if (system.start())
      result = come_to_rest(system);
    if (nodes)
      nodes->end_restarts();
    system.stop();
    destruction.begin(destruction_limit, a_component_failed);
    return result;
  }

  void run_with_faults(ArchitectureDescription architecture) {
    show_step("starting the system");
    TimeLimit destruction;
    auto options = this->options();
    auto nodes = start_local_nodes(architecture, true, plugins_, {}, options);
    std::map<std::string, std::string> hosts;
    for (auto& [host, name] : other_hosts(architecture))
      hosts[name] = host;
    for (auto& x : targets_.components)
      if (x.isolated)
        hosts[x.name] = isolated_host(x.name);
    Notes notes{Clock::now()};
    std::unique_ptr<faults::Injector> injector;
    std::mutex mutex;
    auto with_injector = [&](auto f) {
      std::lock_guard guard{mutex};
      if (injector)
        f(*injector);
    };
    options.on_down = [&](const ComponentDown& x) {
      notes.add(x.component, faults::LifeNote::Kind::down, x.reason);
      if (!x.will_restart)
        notes.add(x.component, faults::LifeNote::Kind::escalated, x.reason);
      with_injector([&](auto& y) { y.on_down(x.component); });
    };
    options.on_up = [&](const ComponentUp& x) {
      notes.add(x.component, faults::LifeNote::Kind::up, {});
    };
    options.watched = faults::watched_by(plan_);
    options.on_watched = [&](std::size_t filter, const ChangeEvent&) {
      with_injector([=](auto& x) { x.on_change(filter); });
    };
    options.on_fault_happened = [&](std::uint64_t fault) {
      with_injector([=](auto& x) { x.on_happened(fault); });
    };
    HistoryWatch histories{architecture, clocks_jump()};
    histories.watch(options);
    System system{std::move(architecture), options};
    histories.look_at_beginning(system);
    auto begin = Clock::now();
    if (!system.start()) {
      system.stop();
      destruction.begin(destruction_limit, a_component_failed);
      return;
    }
    faults::FaultSchedule schedule{plan_, targets_, seed_, duration_};
    result_.plan = faults::to_string(schedule.as_plan());
    ResourceWatch watch{[&] {
      std::map<std::string, pid_t> result{{std::string{faults::coordinator}, getpid()}};
      if (nodes)
        result.merge(nodes->processes());
      return result;
    }};
    {
      std::lock_guard guard{mutex};
      injector = std::make_unique<faults::Injector>(
        faults::InjectorParts{&system,
                              [&](const std::string& process, int signal) {
                                auto host = hosts.find(process);
                                return nodes && host != hosts.end() &&
                                       nodes->signal(host->second, signal);
                              }},
        std::move(schedule));
    }
    show_faults_with([&, since = Clock::now()] {
      using Seconds = std::chrono::duration<double>;
      progress_->update(
        Seconds{Clock::now() - since}.count(), Seconds{duration_}.count(),
        fmt::format("faults: {}, components down: {}", injector->records().size(), notes.down()));
    });
    auto reason = system.wait({duration_, {}});
    show_faults_with({});
    injector->stop();
    look_at_survival(reason, system.ended());
    if (reason == EndReason::time_over)
      compare(come_to_rest(system));
    auto took = std::chrono::duration_cast<Timestamp>(Clock::now() - begin);
    look_at_outages(notes.all(), took);
    look_at_components(system.summary());
    histories.end();
    show_step("stopping the system");
    if (nodes)
      nodes->end_restarts();
    system.stop();
    injector->conclude();
    result_.faults = injector->records();
    {
      std::lock_guard guard{mutex};
      injector.reset();
    }
    look_at_histories(histories);
    look_at_resources(watch.stop());
    destruction.begin(destruction_limit, a_component_failed);
  }

  void look_at_survival(EndReason reason, const std::optional<std::pair<int, std::string>>& ended) {
    std::string problem;
    if (reason == EndReason::all_failed)
      problem = "all components have failed";
    if (ended && ended->first != success)
      problem = "the system ended: " + ended->second;
    else if (ended)
      result_.facts.emplace_back("ended by", ended->second);
    check("survival", problem.empty(), arguments_.duration + " of faults");
    if (!problem.empty())
      violation("survival", problem);
  }

  void compare(const std::vector<std::string>& got) {
    if (question_.types.empty())
      return;
    auto text = difference(wanted_, got);
    check("state as without faults", text.empty(),
          fmt::format("{} entries of the types {}", wanted_.size(), names(question_.types)));
    if (!text.empty())
      violation("state as without faults", text);
  }

  static std::string names(const std::set<std::string>& x) {
    std::string result;
    for (auto& name : x)
      result += (result.empty() ? "" : ", ") + name;
    return result;
  }

  void look_at_outages(const std::vector<faults::LifeNote>& notes, Timestamp end) {
    auto bound = duration(arguments_.bound).value();
    result_.outages =
      faults::outages_of(notes, [&](const std::string&) { return Timestamp{bound}; });
    auto late = faults::late_recoveries(result_.outages, end);
    check("back or given up in time", late.empty(),
          fmt::format("{} outages, bound {}", result_.outages.size(), arguments_.bound));
    for (auto& x : late)
      violation("back or given up in time", x);
  }

  void look_at_components(const SystemSummary& summary) {
    std::string down;
    for (auto& x : summary.components)
      if (x.state == ComponentState::failed)
        down += x.identity.full_name() + " is down: " + x.failure + '\n';
    check("everybody runs in the end", down.empty(),
          fmt::format("{} components", summary.components.size()));
    if (!down.empty())
      violation("everybody runs in the end", down);
  }

  bool clocks_jump() const {
    auto jumps = [](auto& fault) { return std::holds_alternative<faults::JumpClock>(fault); };
    return std::ranges::any_of(plan_.statements,
                               [&](auto& x) { return std::ranges::any_of(x.faults, jumps); });
  }

  void look_at_histories(const HistoryWatch& histories) {
    using Verdict = faults::CheckRecord::Verdict;
    using Kind = linearizability::Verdict::Kind;
    auto judged =
      histories.judge([this](const std::string& name) { show_step("checking " + name); });
    for (auto& [name, x] : judged) {
      auto verdict = x.verdict == Kind::ok          ? Verdict::held
                     : x.verdict == Kind::violation ? Verdict::violated
                                                    : Verdict::undecided;
      result_.checks.push_back({name, verdict, x.grounds});
      if (verdict == Verdict::violated)
        violation(name, x.report);
    }
  }

  void look_at_resources(std::vector<faults::ProcessResources> resources) {
    result_.resources = std::move(resources);
    bool good = true;
    for (auto& process : result_.resources)
      for (auto& leak : faults::leaks(process)) {
        violation("memory, files and threads", leak);
        good = false;
      }
    check("memory, files and threads", good, fmt::format("{} processes", result_.resources.size()));
  }

  void check(const std::string& name, bool held, const std::string& grounds) {
    using Verdict = faults::CheckRecord::Verdict;
    result_.checks.push_back({name, held ? Verdict::held : Verdict::violated, grounds});
  }

  void violation(const std::string& name, const std::string& text) {
    result_.violations.push_back({name, text, {}, seed_, result_.command});
  }

  int finish() {
    progress_.reset();
    if (signals_.count() > 0)
      violation("interrupted", "the run did not come to its end");
    if (!arguments_.report.empty()) {
      make_folder(arguments_.report);
      create(arguments_.report / "chaos.html") << faults::to_html(result_);
      create(arguments_.report / "chaos.json") << faults::to_json(result_);
    }
    if (arguments_.json) {
      json_->print(nlohmann::ordered_json::parse(faults::to_json(result_)));
      return result_.held() ? success : a_component_failed;
    }
    fmt::print("\n{}", faults::to_text(result_, isatty(STDOUT_FILENO) != 0));
    if (!arguments_.report.empty())
      fmt::print("\nwrote {}\n", (arguments_.report / "chaos.html").string());
    return result_.held() ? success : a_component_failed;
  }

  Signals signals_;
  /// What components print is not among it.
  std::optional<JsonOutput> json_;
  const Arguments& arguments_;
  const std::vector<std::string>& plugins_;
  const std::chrono::milliseconds duration_;
  const std::chrono::milliseconds settle_;
  const StateQuestion question_;
  faults::FaultPlan plan_;
  faults::FaultTargets targets_;
  std::uint64_t seed_ = 0;
  std::vector<std::string> wanted_;
  faults::ChaosRun result_;
  std::optional<Progress> progress_;
  std::mutex progress_mutex_;
  std::function<void()> faults_so_far_;
};

} // namespace

void add_chaos(CLI::App& app, Action& chosen, const std::vector<std::string>& plugins) {
  auto* command =
    app.add_subcommand("chaos", "run a system, inject faults, and say whether it recovered");
  auto arguments = std::make_shared<Arguments>();
  add_architecture_arguments(*command, arguments->architecture);
  command
    ->add_option("--plan", arguments->plan,
                 "the faults to inject (docs/fault-plans.md); without, a mix of all that it should "
                 "survive")
    ->type_name("FILE");
  command
    ->add_option("--seed", arguments->seed,
                 "draws what the plan leaves open; the same seed makes "
                 "the same faults")
    ->type_name("N");
  command->add_option("--duration", arguments->duration, "how long faults happen; by default 1min")
    ->type_name("DURATION")
    ->check(check_duration);
  command->add_option("--report", arguments->report, "write chaos.html and chaos.json here")
    ->type_name("DIR")
    ->check(check_output_folder);
  command
    ->add_option("--spread", arguments->spread,
                 "spread everything over so many nodes, whatever hosts the file names")
    ->type_name("N")
    ->check(CLI::Range(1, 100));
  command
    ->add_option("--same", arguments->same,
                 "entries of these types have to be the same in the end as in a run without "
                 "faults, which is made first")
    ->type_name("TYPE")
    ->delimiter(',');
  command
    ->add_option("--but-for", arguments->but_for,
                 "fields that do not count then, such as times and ids")
    ->type_name("FIELD")
    ->delimiter(',');
  command
    ->add_option("--settle", arguments->settle,
                 "the end is when nothing has changed for so long; by default 2s")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option("--bound", arguments->bound,
                 "whatever goes down has to be back, or given up, so soon; by default 10s")
    ->type_name("DURATION")
    ->check(check_duration);
  add_json_flag(*command, arguments->json);
  command->footer(
    "All nodes that the file names are started on this machine.\n"
    "Exit status: 0 if everything held, 1 if something did not, 2 if the run could not be made.\n"
    "Example: castor chaos configs/vision-three-nodes.cast --duration 30s --report out");
  command->callback([&chosen, &plugins, arguments] {
    chosen = [&plugins, arguments] { return Chaos{*arguments, plugins}.run(); };
  });
}

} // namespace castor::cli
