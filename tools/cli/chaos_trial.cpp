#include "castor/tools/cli/chaos_trial.hpp"

#include "castor/actors/node/placement.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/chaos/expected_changes.hpp"
#include "castor/tools/chaos/injector.hpp"
#include "castor/tools/chaos/journal_faults.hpp"
#include "castor/tools/chaos/journal_snapshot.hpp"
#include "castor/tools/chaos/rounded.hpp"
#include "castor/tools/cli/chaos_checks.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/forbidden_changes.hpp"
#include "castor/tools/cli/history_watch.hpp"
#include "castor/tools/cli/local_nodes.hpp"
#include "castor/tools/cli/process_resources.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/signals.hpp"
#include "castor/tools/cli/watched_changes.hpp"
#include "castor/tools/cli/workload_run.hpp"

#include <fmt/core.h>

#include <unistd.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// The longest run without faults, if only what components do is wanted.
constexpr std::chrono::seconds rehearsal{10};

/// How long a system may take to come to rest, unless its workload says otherwise.
constexpr std::chrono::seconds rest_limit{60};

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

bool clocks_jump(const faults::FaultPlan& plan) {
  auto jumps = [](auto& fault) { return std::holds_alternative<faults::JumpClock>(fault); };
  return std::ranges::any_of(plan.statements,
                             [&](auto& x) { return std::ranges::any_of(x.faults, jumps); });
}

/// One start of a system and what comes of it.
class Trial {
public:
  /// @param when as of ChaosChecks
  Trial(const ChaosSetup& setup, const Signals& signals, Progress& progress, faults::ChaosRun& run,
        std::string when)
    : setup_(setup), signals_(signals), progress_(progress), run_(run),
      checks_(setup, run, std::move(when)) {}

  FaultlessRun without_faults() {
    FaultlessRun result;
    result.workload_seed = setup_.workload_seed(run_.seed);
    show_step("starting the system without faults");
    TimeLimit destruction;
    auto options = this->options();
    auto architecture = setup_.architecture;
    const faults::JournalSnapshot snapshot{faults::journals_of(architecture)};
    auto work = prepare_work(architecture);
    auto nodes = start_local_nodes(architecture, true, setup_.plugins, {}, options);
    if (work)
      work->watch(options);
    ForbiddenChanges forbidden{checks_.forbidden()};
    forbidden.watch(options);
    faults::ExpectedChanges expected{checks_.demanded()};
    watch(options, expected);
    System system{std::move(architecture), options};
    if (system.start()) {
      faults::ActivityMeter meter;
      if (work)
        work->begin();
      // What a workload does and what comes of it takes its time.
      auto whole = work && !setup_.compared.types.empty();
      wait_and_measure(system,
                       whole ? setup_.duration
                             : std::min<std::chrono::milliseconds>(setup_.duration, rehearsal),
                       meter);
      if (work)
        work->finish_actions();
      result.activity = meter.by_component();
      await(expected, system);
      if (needs_rest())
        result.state = come_to_rest(system, [] { return false; });
      if (work)
        checks_.workload(*work);
      checks_.forbidden_changes(forbidden);
      checks_.expected_changes(expected);
    }
    if (nodes)
      nodes->end_restarts();
    system.stop();
    destruction.begin(destruction_limit, a_component_failed);
    result.violations = std::move(run_.violations);
    return result;
  }

  void with_faults(const faults::FaultPlan& plan, const std::vector<std::string>& wanted,
                   const std::function<void()>& report) {
    show_step("starting the system");
    TimeLimit destruction;
    auto options = this->options();
    auto architecture = setup_.architecture;
    auto work = prepare_work(architecture);
    auto nodes = start_local_nodes(architecture, true, setup_.plugins, {}, options);
    std::map<std::string, std::string> hosts;
    for (auto& [host, name] : other_hosts(architecture))
      hosts[name] = host;
    for (auto& x : setup_.targets.components)
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
    options.watched = faults::watched_by(plan);
    options.on_watched = [&](std::size_t filter, const ChangeEvent&) {
      with_injector([=](auto& x) { x.on_change(filter); });
    };
    options.on_fault_happened = [&](std::uint64_t fault) {
      with_injector([=](auto& x) { x.on_happened(fault); });
    };
    auto journals = faults::journals_of(architecture);
    HistoryWatch histories{architecture, clocks_jump(plan)};
    histories.watch(options);
    if (work)
      work->watch(options);
    ForbiddenChanges forbidden{checks_.forbidden()};
    forbidden.watch(options);
    faults::ExpectedChanges expected{checks_.demanded()};
    watch(options, expected);
    System system{std::move(architecture), options};
    histories.look_at_beginning(system);
    auto begin = Clock::now();
    if (!system.start()) {
      system.stop();
      conclude(report, destruction);
      return;
    }
    faults::FaultSchedule schedule{plan, setup_.targets, run_.seed, setup_.duration};
    run_.plan = faults::to_string(schedule.as_plan());
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
      progress_.update(
        Seconds{Clock::now() - since}.count(), Seconds{setup_.duration}.count(),
        fmt::format("faults: {}, components down: {}", injector->records().size(), notes.down()));
    });
    if (work)
      work->begin();
    faults::ActivityMeter meter;
    auto reason = wait_and_measure(system, setup_.duration, meter);
    run_.activity = meter.total();
    show_faults_with({});
    injector->stop();
    if (work)
      work->finish_actions();
    checks_.survival(reason, system.ended());
    if (reason == EndReason::time_over) {
      await(expected, system);
      checks_.state(wanted, come_to_rest(system, [&] { return notes.down() > 0; }));
    }
    if (work)
      run_.workload = checks_.workload(*work);
    checks_.forbidden_changes(forbidden);
    checks_.expected_changes(expected);
    auto took = std::chrono::duration_cast<Timestamp>(Clock::now() - begin);
    checks_.outages(notes.all(), took);
    checks_.components(system.summary());
    histories.end();
    show_step("stopping the system");
    if (nodes)
      nodes->end_restarts();
    system.stop();
    injector->conclude();
    run_.faults = injector->records();
    for (auto& x : run_.faults)
      if (!x.violation.empty())
        checks_.violation(x.fault, x.violation);
    {
      std::lock_guard guard{mutex};
      injector.reset();
    }
    checks_.histories(histories, [this](auto& name) { show_step("checking " + name); });
    checks_.resources(watch.stop());
    conclude(report, destruction);
  }

private:
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
    if (!progress_.due())
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
  void show_step(const std::string& what) { progress_.update(0, {}, what); }

  /// Whether a run without faults is judged by what it comes to.
  bool needs_rest() const {
    return !setup_.compared.types.empty() ||
           (setup_.workload && setup_.workload->workload.answer_within);
  }

  std::chrono::milliseconds longest_rest() const {
    if (!setup_.workload || !setup_.workload->workload.rest_within)
      return rest_limit;
    return std::chrono::ceil<std::chrono::milliseconds>(*setup_.workload->workload.rest_within);
  }

  /// Lets the system come to rest, and takes its state.
  std::vector<std::string> come_to_rest(System& system, const std::function<bool()>& is_any_down) {
    show_step("waiting until nothing changes any more");
    // What is down for longer than the bound is found to be so; nobody needs to wait for it.
    const auto limit = longest_rest();
    auto at_first = std::min<std::chrono::milliseconds>(setup_.bound + setup_.settle, limit);
    auto reason = system.wait({at_first, setup_.settle});
    if (reason == EndReason::time_over && !is_any_down())
      reason = system.wait({limit - at_first, setup_.settle});
    if (reason == EndReason::time_over)
      checks_.violation(
        "rest", is_any_down() ? "the system did not come to rest, since not everything is back"
                              : "the system did not come to rest within " + faults::rounded(limit));
    return state_of(system, setup_.compared);
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

  /// Nothing without a workload.
  std::unique_ptr<WorkloadRun> prepare_work(ArchitectureDescription& architecture) {
    if (!setup_.workload)
      return nullptr;
    auto result = std::make_unique<WorkloadRun>(*setup_.workload, setup_.workload_seed(run_.seed),
                                                setup_.duration);
    result->prepare(architecture);
    return result;
  }

  /// Components that do not come back from their own code keep the system from being destroyed, and
  /// then the process ends.
  void conclude(const std::function<void()>& report, TimeLimit& destruction) {
    if (signals_.count() > 0)
      checks_.violation("interrupted", "the run did not come to its end");
    report();
    destruction.begin(destruction_limit, a_component_failed);
  }

  static void watch(SystemOptions& options, faults::ExpectedChanges& expected) {
    watch_changes(options, expected.filters(),
                  [&expected](std::size_t filter, const ChangeEvent& event) {
                    expected.note(filter, event.address);
                  });
  }

  /// Lets entries become what they are to become.
  void await(faults::ExpectedChanges& expected, System& system) {
    if (checks_.demanded().empty())
      return;
    constexpr auto look_every = 200ms;
    show_step("waiting until all entries are as they are to become");
    const auto until = Clock::now() + expected.patience();
    for (;;) {
      // A working memory that was down may not have told all changes.
      for (auto& name : system.subarchitectures())
        for (auto& entry : system.entries(name))
          expected.note(*entry);
      if (expected.is_complete() || Clock::now() >= until ||
          system.wait({look_every, {}}) != EndReason::time_over)
        return;
    }
  }

  const ChaosSetup& setup_;
  const Signals& signals_;
  Progress& progress_;
  faults::ChaosRun& run_;
  ChaosChecks checks_;
  std::mutex progress_mutex_;
  std::function<void()> faults_so_far_;
};

} // namespace

FaultlessRun run_without_faults(const ChaosSetup& setup, std::uint64_t seed, const Signals& signals,
                                Progress& progress) {
  faults::ChaosRun run;
  run.seed = seed;
  return Trial{setup, signals, progress, run, " without faults"}.without_faults();
}

void run_with_faults(const ChaosSetup& setup, const faults::FaultPlan& plan,
                     const std::vector<std::string>& wanted, const Signals& signals,
                     Progress& progress, faults::ChaosRun& run,
                     const std::function<void()>& report) {
  Trial{setup, signals, progress, run, {}}.with_faults(plan, wanted, report);
}

} // namespace castor::cli
