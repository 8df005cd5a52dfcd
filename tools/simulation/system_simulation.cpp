#include "castor/tools/simulation/system_simulation.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/chaos/minimise.hpp"
#include "castor/tools/simulation/final_checks.hpp"
#include "castor/tools/simulation/memory_losses.hpp"
#include "castor/tools/simulation/simulated_architecture.hpp"
#include "castor/tools/simulation/simulated_coordinator.hpp"
#include "castor/tools/simulation/simulated_machines.hpp"
#include "castor/tools/simulation/simulation_schedule.hpp"
#include "castor/tools/simulation/testing_system.hpp"

#include <caf/actor_registry.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace castor::simulation {

namespace {

using namespace std::chrono_literals;
using linearizability::OperationKind;

/// So short that leases run out while the system runs, or so long that only their holders end them.
constexpr std::array<std::chrono::milliseconds, 3> lease_durations{300ms, 300ms, 3000ms};
/// The system is whole again so long after everything works.
constexpr Timestamp most_recovery{20s};
/// A component is back so soon if nothing but components fails.
constexpr Timestamp most_downtime{2s};

/// The simulation of one seed.
class SeededRun {
public:
  SeededRun(TestingSystem& stage, std::uint64_t seed, SystemResult& result)
    : stage_(stage), result_(result), lease_(lease_durations[seed % lease_durations.size()]),
      world_(seed, lease_), machines_(stage.system, world_, machine_count(seed)),
      schedule_(stage, world_, machines_, seed), coordinator_(stage.system, world_, machines_),
      checks_(stage, schedule_, world_, machines_, architecture_, lease_) {
    world_.run_jobs_of = [this](Life x) { schedule_.run_jobs_of(x); };
  }
  SeededRun(const SeededRun&) = delete;
  SeededRun& operator=(const SeededRun&) = delete;

  void run(linearizability::Checker& checker) {
    try {
      set_up();
      play();
      if (world_.findings.empty())
        checks_.run();
    } catch (const std::exception& error) {
      world_.find(error.what());
    }
    result_.steps = schedule_.steps();
    result_.losses = note_losses(world_, machines_);
    result_.history = world_.recorder.finish();
    result_.verdict = checker.check(result_.history);
    count(checks_.journal_counts());
    for (auto& x : result_.history)
      world_.note(to_string(x));
    result_.digest = world_.digest;
    clear();
    if (auto actors = stage_.system.registry().running(); actors != actors_before_)
      world_.find(std::to_string(actors - actors_before_) + " actors are left");
    result_.findings = std::move(world_.findings);
  }

private:
  // -- setting up

  void set_up() {
    world_.recorder.set_time(Timestamp{0});
    auto strategy = world_.pick(3);
    auto escalates = world_.chance(30);
    architecture_ = simulated_architecture({lease_, strategy, escalates, world_.chance(40),
                                            machines_.count(), journal_mode(result_.seed)});
    for_each_component(architecture_, [&](ComponentDescription& x) {
      auto home = std::size_t(x.subarchitecture.front() - 'a');
      auto strays = x.kind == ComponentKind::managed && world_.chance(20);
      x.host =
        machine_names[(strays ? world_.pick(machine_names.size()) : home) % machines_.count()];
      if (x.host == machine_names[0])
        x.host = "localhost";
    });
    for (auto& x : architecture_.subarchitectures)
      world_.working_memories.push_back({x.name, {}});
    for (std::size_t entries = 2 + world_.pick(3), i = 0; i < entries; ++i) {
      auto owner = world_.pick(3);
      world_.entries.push_back(
        {{world_.working_memories[owner].subarchitecture, std::string(1, char('w' + i))}, owner});
    }
    world_.longest_pause = std::chrono::milliseconds{1 + world_.pick(200)};
    world_.operations_left = 20 + world_.pick(50);
    if (world_.chance(50))
      world_.tasks_left = 3 + world_.pick(10);
    world_.task_rules.budget = 2;
    world_.task_rules.backfill = world_.chance(50);
    world_.tasks.set_have_lost([this](Life a, Life b) { return machines_.have_lost(a, b); });
    world_.serves_calls = world_.chance(40);
    if (world_.serves_calls)
      world_.calls.calls_left = 1 + world_.pick(3);
    world_.calls.find = [this](std::string what) { world_.find(std::move(what)); };
    world_.calls.note = [this](const std::string& what) { world_.note(what); };
    machines_.network().set_delays(unsigned(world_.pick(50)),
                                   std::chrono::milliseconds{world_.pick(20)});
    coordinator_.start(architecture_,
                       {[this](const ComponentDown& x) { went_down(x); },
                        [this](const ComponentUp& x) { came_up(x); }},
                       schedule_.begin());
    if (!schedule_.advance_until(schedule_.time() + 20s,
                                 [this] { return coordinator_.has_started(); }))
      throw std::runtime_error{"the system does not start"};
  }

  // -- playing

  void play() {
    auto& faults = result_.faults.statements;
    auto start = schedule_.time();
    for (auto& x : faults)
      schedule_.add_fault(start + std::get<faults::At>(x.trigger).time, x.faults.front());
    schedule_.advance(start + time_of_faults);
    // The last of them may take its time.
    auto lasts_until = schedule_.time();
    for (auto& x : faults)
      if (auto duration = faults::duration_of(x.faults.front()))
        lasts_until =
          std::max(lasts_until, start + std::get<faults::At>(x.trigger).time + *duration);
    schedule_.advance(lasts_until);
    machines_.heal();
    recover();
  }

  void recover() {
    auto until = schedule_.time() + most_recovery;
    constexpr Timestamp calm{500ms};
    while (schedule_.time() < until && world_.findings.empty()) {
      schedule_.advance_until(until, [this] { return why_not_whole().empty(); });
      auto failures = result_.failures;
      schedule_.advance(schedule_.time() + calm);
      if (failures == result_.failures && why_not_whole().empty())
        return;
    }
    if (!world_.findings.empty())
      return;
    auto why = why_not_whole();
    world_.find("it has not recovered: " + (why.empty() ? "components fail again and again" : why));
  }

  /// Empty if all of the system is there.
  std::string why_not_whole() const {
    if (auto& why = coordinator_.ended())
      return "it has ended: " + *why;
    for (auto& x : architecture_.subarchitectures) {
      auto lives = machines_.memories().find(x.name);
      if (lives == machines_.memories().end() || !lives->second.back().alive())
        return "there is no working memory of " + x.name;
      for (auto* component : {&x.task_manager, &x.components[0], &x.components[1]}) {
        auto i = world_.components.find(component->name);
        if (i == world_.components.end())
          return component->name + " is not there";
        if (i->second->record().state() != ComponentState::running)
          return component->name + " does not run";
      }
    }
    if (!down_.empty())
      return down_.begin()->first + " is not reported as up";
    return {};
  }

  // -- what is made known

  void went_down(const ComponentDown& x) {
    ++result_.failures;
    world_.note(x.component);
    world_.note(std::uint64_t(schedule_.time().count()));
    if (!x.will_restart)
      world_.find(x.component + " is not started again: " + x.reason);
    down_.emplace(x.component, schedule_.time());
  }

  void came_up(const ComponentUp& x) {
    ++result_.returns;
    world_.note(x.component);
    auto since = down_.extract(x.component);
    if (!since)
      world_.find(x.component + " is reported as up and was not down");
    else if (!machines_.are_processes_affected() &&
             schedule_.time() - since.mapped() > most_downtime)
      world_.find(x.component + " was not there for " +
                  std::to_string((schedule_.time() - since.mapped()).count() / 1000) + " ms");
  }

  void count(const JournalCounts& journals) {
    auto& happened = result_.happened;
    happened.add("machines", std::to_string(machines_.count()));
    for (auto& x : result_.faults.statements)
      happened.add("faults", std::string{kind_of(x.faults.front())});
    happened.add("outages", "component down", result_.failures);
    happened.add("outages", "component back", result_.returns);
    happened.add("outages", "working memory lost its entries", result_.losses);
    for (auto& [name, lives] : machines_.memories())
      for (auto& x : lives)
        if (x.session != 0) {
          happened.add("journals", x.session == 1 ? "opened" : "opened again");
          happened.add("journals", "entry recovered", x.image->entries.size());
        }
    happened.add("journals", "change with an event found in the journal", journals.found);
    happened.add("journals", "change with an event lost, within the bound", journals.lost);
    happened.add("journals", "lost changes reached the bound", journals.lost_at_bound);
    happened.add(world_.tasks.happened());
    happened.add(world_.calls.happened);
    for (auto& x : result_.history) {
      using enum OperationKind;
      if (x.kind == lapse || x.kind == loss)
        continue;
      ++result_.operations;
      happened.add("operations", to_string(x.kind) + ' ' +
                                   (x.pending() ? "not answered" : to_string(x.result.status)));
    }
  }

  void clear() {
    auto& scheduler = stage_.scheduler;
    world_.over = true;
    machines_.end();
    coordinator_.end();
    scheduler.run();
    coordinator_.close();
    scheduler.run();
    scheduler.clock().cancel_all();
    scheduler.run();
  }

  TestingSystem& stage_;
  const std::size_t actors_before_ = stage_.system.registry().running();
  SystemResult& result_;
  const std::chrono::milliseconds lease_;
  ArchitectureDescription architecture_;
  SystemWorld world_;
  SimulatedMachines machines_;
  SimulationSchedule schedule_;
  SimulatedCoordinator coordinator_;
  FinalChecks checks_;
  /// Components that are down, and since when.
  std::map<std::string, Timestamp> down_;
};

} // namespace

/// The actor system, which outlasts a seed.
class SystemSimulation::Stage {
public:
  Stage() { set_log_level(LogLevel::off); }

  SystemResult run(std::uint64_t seed, const faults::FaultPlan& faults) {
    SystemResult result;
    result.faults = faults;
    result.seed = seed;
    SeededRun{system_, seed, result}.run(checker_);
    return result;
  }

private:
  TestingSystem system_;
  linearizability::Checker checker_{{.max_states = 1'000'000}};
};

SystemSimulation::SystemSimulation() : stage_(std::make_unique<Stage>()) {}
SystemSimulation::~SystemSimulation() = default;

SystemResult SystemSimulation::run(std::uint64_t seed,
                                   const std::optional<faults::FaultPlan>& faults) {
  return stage_->run(seed, faults ? *faults : system_faults(seed));
}

faults::FaultPlan minimised(SystemSimulation& simulation, std::uint64_t seed,
                            const faults::FaultPlan& faults) {
  auto result = faults;
  result.statements = castor::faults::minimise<castor::faults::Statement>(
    faults.statements, [&](const std::vector<castor::faults::Statement>& some) {
      auto fewer = faults;
      fewer.statements = some;
      return simulation.run(seed, fewer).is_wrong();
    });
  return result;
}

} // namespace castor::simulation
