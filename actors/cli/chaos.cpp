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
#include "castor/actors/cli/read_workload.hpp"
#include "castor/actors/cli/seeds_option.hpp"
#include "castor/actors/cli/signals.hpp"
#include "castor/actors/cli/workload_run.hpp"
#include "castor/actors/cli/writable.hpp"
#include "castor/actors/component/log.hpp"
#include "castor/actors/faults/activity.hpp"
#include "castor/actors/faults/chaos_report.hpp"
#include "castor/actors/faults/coverage.hpp"
#include "castor/actors/faults/injector.hpp"
#include "castor/actors/faults/journal_faults.hpp"
#include "castor/actors/faults/outages.hpp"
#include "castor/actors/faults/random_plan.hpp"
#include "castor/actors/faults/resource_growth.hpp"
#include "castor/actors/faults/rounded.hpp"
#include "castor/actors/node/check.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/system.hpp"
#include "castor/actors/simulation/seeds.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
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

/// The longest run without faults, if only what components do is wanted.
constexpr std::chrono::seconds rehearsal{10};

struct Arguments {
  ArchitectureArguments architecture;
  std::string plan;
  std::string workload;
  std::optional<std::uint64_t> seed;
  std::string duration = "1min";
  std::filesystem::path report;
  int spread = 0;
  std::vector<std::string> same;
  std::vector<std::string> but_for;
  std::string settle = "2s";
  std::string bound = "10s";
  std::optional<double> rate;
  std::string seeds;
  bool find_limit = false;
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
    targets_ = targets_in(*architecture);
    if (!arguments_.plan.empty()) {
      auto plan = read_plan(arguments_.plan, targets_);
      if (!plan)
        return bad_input;
      plan_ = *std::move(plan);
    }
    if (!take_workload(*architecture))
      return bad_input;
    auto first_seed =
      arguments_.seeds.empty()
        ? arguments_.seed.value_or(plan_.seed.value_or(new_incarnation() % 1'000'000))
        : simulation::parse_seeds(arguments_.seeds).from;
    progress_.emplace("chaos");
    if (!question_.types.empty() || !has_plan()) {
      note(LogLevel::info, "first without faults, to see what it does and how it ends then");
      look_at_peace(*architecture, first_seed);
      if (signals_.count() > 0)
        return a_component_failed;
    }
    if (arguments_.find_limit)
      return find_limit(*architecture);
    if (!arguments_.seeds.empty())
      return run_seeds(*architecture);
    run_once(*architecture, first_seed, arguments_.report);
    progress_.reset();
    return finish();
  }

private:
  bool has_plan() const { return !arguments_.plan.empty(); }

  /// How the system does without the faults of that seed, and what it does then.
  void look_at_peace(const ArchitectureDescription& architecture, std::uint64_t seed) {
    show_step("starting the system without faults");
    result_ = {};
    seed_ = seed;
    peace_seed_ = seed;
    wanted_ = run_in_peace(architecture);
    peace_violations_ = std::move(result_.violations);
  }

  void run_once(const ArchitectureDescription& architecture, std::uint64_t seed,
                const std::filesystem::path& report) {
    seed_ = seed;
    report_ = report;
    if (!has_plan())
      plan_ = faults::random_plan(targets_, seed, duration_, random_options());
    result_ = {};
    result_.system = arguments_.architecture.file;
    result_.command = command();
    result_.seed = seed_;
    result_.duration = duration_;
    result_.targets = targets_;
    for (auto& x : peace_violations_)
      violation(x.check, x.text);
    run_with_faults(architecture);
    if (signals_.count() > 0)
      violation("interrupted", "the run did not come to its end");
    write_report();
  }

  faults::RandomPlanOptions random_options() const {
    faults::RandomPlanOptions result;
    result.activity = usual_activity_;
    if (arguments_.rate) {
      result.interval = interval_of(*arguments_.rate);
      result.within_restart_limits = false;
    }
    return result;
  }

  static Timestamp interval_of(double faults_per_minute) {
    return std::chrono::duration_cast<Timestamp>(
      std::chrono::duration<double>{60 / faults_per_minute});
  }

  static int status_of(const faults::ChaosRun& x) {
    return !x.held() ? a_component_failed : x.vacuous().empty() ? success : vacuous_run;
  }

  /// One run after the other, each with the faults of its seed.
  int run_seeds(const ArchitectureDescription& architecture) {
    auto seeds = simulation::parse_seeds(arguments_.seeds);
    faults::Coverage coverage{targets_};
    std::map<int, std::size_t> counts;
    for (auto seed = seeds.from; seed <= seeds.to && signals_.count() == 0; ++seed) {
      // Other actions are drawn, from which another state follows.
      if (!question_.types.empty() && workload_seed(seed) != workload_seed(peace_seed_))
        look_at_peace(architecture, seed);
      run_once(architecture, seed,
               arguments_.report.empty() ? std::filesystem::path{}
                                         : arguments_.report / std::to_string(seed));
      coverage.add(result_.faults);
      ++counts[status_of(result_)];
      const ProgressPause pause;
      if (arguments_.json)
        json_->print(nlohmann::ordered_json::parse(faults::to_json(result_)));
      else
        fmt::print("{}\n", faults::to_line(result_, isatty(STDOUT_FILENO) != 0));
      std::fflush(stdout);
    }
    progress_.reset();
    if (!arguments_.json)
      fmt::print("\n{} held, {} violated, {} vacuous; {}", counts[success],
                 counts[a_component_failed], counts[vacuous_run], faults::to_text(coverage));
    for (auto status : {a_component_failed, vacuous_run})
      if (counts[status] > 0)
        return status;
    return success;
  }

  // -- the limit of supervision

  /// Whether the supervisors bear so many failures a minute.
  bool bears(const ArchitectureDescription& architecture, double failures_per_minute) {
    faults::RandomPlanOptions options;
    options.activity = usual_activity_;
    options.interval = interval_of(failures_per_minute);
    options.within_restart_limits = false;
    options.failures_only = true;
    seed_ = arguments_.seed.value_or(1);
    plan_ = faults::random_plan(targets_, seed_, duration_, options);
    result_ = {};
    run_with_faults(architecture);
    auto given_up = std::ranges::find_if(result_.outages,
                                         [](auto& x) { return !x.up && x.escalated.has_value(); });
    auto survival = std::ranges::find(result_.violations, "survival", &faults::Violation::check);
    auto result = given_up == result_.outages.end() && survival == result_.violations.end();
    auto why = result ? std::string{"borne"}
               : survival != result_.violations.end()
                 ? survival->text
                 : given_up->target + " was given up: " + given_up->reason;
    auto failures = result_.outages.size();
    const ProgressPause pause;
    if (arguments_.json)
      json_->print({{"failures_per_minute", failures_per_minute},
                    {"outages", failures},
                    {"borne", result},
                    {"reason", result ? "" : why}});
    else
      fmt::print("{:6.1f} failures a minute, {:3} outages: {}\n", failures_per_minute, failures,
                 why);
    std::fflush(stdout);
    return result;
  }

  /// Bisects between a rate that is borne and one that is not.
  int find_limit(const ArchitectureDescription& architecture) {
    constexpr double lowest = 1;
    constexpr double highest = 3840;
    constexpr double close_enough = 1.2;
    double borne = 0;
    double too_much = 0;
    for (double rate = arguments_.rate.value_or(15); signals_.count() == 0;) {
      (bears(architecture, rate) ? borne : too_much) = rate;
      if (too_much == 0 ? borne >= highest : too_much <= lowest)
        break;
      if (borne > 0 && too_much > 0 && too_much < close_enough * borne)
        break;
      rate = too_much == 0 ? 2 * borne : borne == 0 ? too_much / 2 : std::sqrt(borne * too_much);
    }
    progress_.reset();
    if (signals_.count() > 0)
      return a_component_failed;
    if (!arguments_.json)
      fmt::print("\n{}: {}\n", arguments_.architecture.file,
                 too_much == 0 ? fmt::format("{:.1f} failures a minute are borne", borne)
                 : borne == 0
                   ? fmt::format("{:.1f} failures a minute are too many", too_much)
                   : fmt::format("{:.1f} failures a minute are borne, {:.1f} are too many", borne,
                                 too_much));
    return success;
  }

  /// Where the plan of a run with a report is kept, with nothing left to draw.
  std::filesystem::path kept_plan() const {
    return report_.empty() ? std::filesystem::path{} : report_ / "chaos.plan";
  }

  /// The user's, or the one beside the system's file; false if it cannot be done.
  bool take_workload(const ArchitectureDescription& architecture) {
    auto file = workload_beside(arguments_.workload, architecture.file);
    if (file.empty())
      return true;
    // Loads the libraries that know the entry types that it names.
    auto problems = check_architecture(architecture);
    print(problems);
    if (!problems.empty())
      return false;
    workload_ = read_workload(file, architecture);
    if (!workload_)
      return false;
    note(LogLevel::info, "workload: " + file);
    if (auto& same = workload_->workload.same) {
      question_.types.insert(same->types.begin(), same->types.end());
      question_.ignored.insert(same->but_for.begin(), same->but_for.end());
    }
    return true;
  }

  /// What draws the actions of the workload, in a run with this seed.
  std::uint64_t workload_seed(std::uint64_t seed) const {
    return workload_ ? workload_->workload.seed.value_or(seed) : 0;
  }

  /// Nothing without a workload.
  std::unique_ptr<WorkloadRun> prepare_work(ArchitectureDescription& architecture) {
    if (!workload_)
      return nullptr;
    auto result = std::make_unique<WorkloadRun>(*workload_, workload_seed(seed_), duration_);
    result->prepare(architecture);
    return result;
  }

  /// What makes the same faults once more.
  std::string command() const {
    std::string result = "castor";
    for (auto& x : plugins_)
      result += " --plugin " + x;
    result += " chaos " + arguments_.architecture.file;
    if (has_plan())
      result += " --plan " + arguments_.plan;
    else if (!report_.empty())
      result += " --plan " + kept_plan().string();
    else if (arguments_.rate)
      result += fmt::format(" --rate {}", *arguments_.rate);
    if (workload_)
      result += " --workload " + workload_->workload.file;
    else if (!arguments_.workload.empty())
      result += " --workload " + arguments_.workload;
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
    auto work = prepare_work(architecture);
    auto nodes = start_local_nodes(architecture, true, plugins_, {}, options);
    if (work)
      work->watch(options);
    System system{std::move(architecture), options};
    std::vector<std::string> result;
    if (system.start()) {
      faults::ActivityMeter meter;
      if (work)
        work->begin();
      // What a workload does and what comes of it takes its time.
      auto whole = work && !question_.types.empty();
      wait_and_measure(
        system, whole ? duration_ : std::min<std::chrono::milliseconds>(duration_, rehearsal),
        meter);
      if (work)
        work->finish_actions();
      usual_activity_ = meter.by_component();
      result = come_to_rest(system);
      if (work)
        look_at_work(*work, " without faults");
    }
    if (nodes)
      nodes->end_restarts();
    system.stop();
    destruction.begin(destruction_limit, a_component_failed);
    return result;
  }

  /// As System::wait, with a look at what components do, about once a second.
  EndReason wait_and_measure(System& system, std::chrono::milliseconds at_most,
                             faults::ActivityMeter& meter) {
    auto begin = Clock::now();
    auto passed = [&] { return std::chrono::duration_cast<Timestamp>(Clock::now() - begin); };
    auto measure = [&] {
      std::vector<faults::ComponentSample> samples;
      for (auto& x : system.summary().components)
        samples.push_back(
          {x.identity.name, x.identity.incarnation, x.callbacks, x.reads + x.writes});
      meter.take(passed(), samples);
    };
    for (measure(); passed() < at_most;) {
      auto reason = system.wait({std::min<std::chrono::nanoseconds>(1s, at_most - passed()), {}});
      if (reason != EndReason::time_over)
        return reason;
      measure();
    }
    return EndReason::time_over;
  }

  void run_with_faults(ArchitectureDescription architecture) {
    show_step("starting the system");
    TimeLimit destruction;
    auto options = this->options();
    auto work = prepare_work(architecture);
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
    auto journals = faults::journals_of(architecture);
    HistoryWatch histories{architecture, clocks_jump()};
    histories.watch(options);
    if (work)
      work->watch(options);
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
                              [&](const std::string& process, const std::function<void(pid_t)>& f) {
                                auto host = hosts.find(process);
                                return nodes && host != hosts.end() &&
                                       nodes->with_process(host->second, f);
                              },
                              std::move(journals)},
        std::move(schedule));
    }
    show_faults_with([&, since = Clock::now()] {
      using Seconds = std::chrono::duration<double>;
      progress_->update(
        Seconds{Clock::now() - since}.count(), Seconds{duration_}.count(),
        fmt::format("faults: {}, components down: {}", injector->records().size(), notes.down()));
    });
    if (work)
      work->begin();
    faults::ActivityMeter meter;
    auto reason = wait_and_measure(system, duration_, meter);
    result_.activity = meter.total();
    show_faults_with({});
    injector->stop();
    if (work)
      work->finish_actions();
    look_at_survival(reason, system.ended());
    if (reason == EndReason::time_over)
      compare(come_to_rest(system));
    if (work)
      result_.workload = look_at_work(*work, {});
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
    for (auto& x : result_.faults)
      if (!x.violation.empty())
        violation(x.fault, x.violation);
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

  faults::WorkloadRecord look_at_work(WorkloadRun& work, const std::string& when) {
    auto record = work.end();
    auto total = record.total();
    auto undone = faults::actions_missing(record);
    if (when.empty())
      check("workload done", undone.empty(),
            fmt::format("{} of {} actions", total.done, total.due));
    if (!undone.empty())
      violation("workload done" + when, undone);
    auto& within = workload_->workload.answer_within;
    if (!within)
      return record;
    auto missing = faults::answers_missing(work.sentences(), within);
    if (when.empty())
      check("sentences answered", missing.empty(),
            fmt::format("{} sentences, within {}", total.said, faults::rounded(*within)));
    if (!missing.empty())
      violation("sentences answered" + when, missing);
    return record;
  }

  void look_at_outages(const std::vector<faults::LifeNote>& notes, Timestamp end) {
    auto bound = duration(arguments_.bound).value();
    result_.outages =
      faults::outages_of(notes, [&](const std::string&) { return Timestamp{bound}; });
    for (auto& x : result_.outages)
      x.kind = faults::word_for(targets_, x.target);
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

  void write_report() const {
    if (report_.empty())
      return;
    make_folder(report_);
    create(report_ / "chaos.html") << faults::to_html(result_);
    create(report_ / "chaos.json") << faults::to_json(result_);
    create(kept_plan()) << result_.plan;
  }

  int finish() {
    if (arguments_.json) {
      json_->print(nlohmann::ordered_json::parse(faults::to_json(result_)));
      return status_of(result_);
    }
    fmt::print("\n{}", faults::to_text(result_, isatty(STDOUT_FILENO) != 0));
    if (!report_.empty())
      fmt::print("\nwrote {}\n", (report_ / "chaos.html").string());
    return status_of(result_);
  }

  Signals signals_;
  /// What components print is not among it.
  std::optional<JsonOutput> json_;
  const Arguments& arguments_;
  const std::vector<std::string>& plugins_;
  const std::chrono::milliseconds duration_;
  const std::chrono::milliseconds settle_;
  StateQuestion question_;
  /// The user's, or the random one of the present run.
  faults::FaultPlan plan_;
  faults::FaultTargets targets_;
  std::optional<CheckedWorkload> workload_;
  std::uint64_t seed_ = 0;
  std::filesystem::path report_;
  /// How it ends without faults, with the workload of that seed, and what is wrong even then.
  std::vector<std::string> wanted_;
  std::uint64_t peace_seed_ = 0;
  std::vector<faults::Violation> peace_violations_;
  /// What components do without faults.
  std::optional<faults::ActivityByComponent> usual_activity_;
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
    ->add_option("--workload", arguments->workload,
                 "what somebody says and does meanwhile (docs/fault-plans.md); by default the file "
                 "beside FILE whose name ends with .workload, if there is one; none: nothing")
    ->type_name("FILE");
  command
    ->add_option("--seed", arguments->seed,
                 "draws what the plan leaves open; the same seed makes "
                 "the same faults")
    ->type_name("N");
  auto seeds = command
                 ->add_option("--seeds", arguments->seeds,
                              "one run for each of these seeds, and what all of them hit")
                 ->type_name("FROM..TO")
                 ->check(check_seeds)
                 ->excludes("--seed");
  command
    ->add_option("--rate", arguments->rate,
                 "faults per minute, whatever restarts that takes; without, 30, but fewer where "
                 "supervisors would not allow so many restarts")
    ->type_name("N")
    ->check(CLI::Range(0.1, 6000.0))
    ->excludes("--plan");
  command
    ->add_flag("--find-limit", arguments->find_limit,
               "try out how many failures per minute the supervisors bear, by bisection; each try "
               "lasts --duration")
    ->excludes("--plan")
    ->excludes(seeds);
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
    "Exit status: 0 if everything held, 1 if something did not, 2 if the run could not be made,\n"
    "4 if it shows nothing, because nothing went down or hardly anything was going on.\n"
    "Example: castor chaos configs/vision-three-nodes.cast --duration 30s --report out");
  command->callback([&chosen, &plugins, arguments] {
    chosen = [&plugins, arguments] { return Chaos{*arguments, plugins}.run(); };
  });
}

} // namespace castor::cli
