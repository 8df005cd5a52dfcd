#pragma once

#include "castor/actors/supervision/failover.hpp"
#include "castor/actors/supervision/supervision_tree.hpp"
#include "castor/actors/supervision/system_model.hpp"
#include "castor/actors/supervision/transition_scheduler.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

/// The children of a system without actors: keeps what a TransitionScheduler commands, until the
/// test says what becomes of it, and writes down what it says.
class SimulatedChildren : public TransitionDriver, public TransitionObserver {
public:
  struct Making {
    std::vector<std::string> children;
    bool by_plan = false;
    std::function<void(const std::set<std::string>&)> done;
  };

  struct PhaseCommand {
    std::string child;
    std::uint64_t incarnation = 0;
    Phase phase = Phase::configure;
  };

  explicit SimulatedChildren(const ArchitectureDescription& architecture) {
    tree.set(architecture);
    model.set(architecture, std::chrono::seconds{5});
  }

  // -- commands to carry out

  std::vector<std::pair<TimePoint, TransitionReminder>> reminders;
  /// With the lives that are to end.
  std::vector<std::pair<std::string, std::uint64_t>> stops;
  std::vector<Making> makings;
  std::vector<PhaseCommand> phases;

  // -- what the scheduler asks

  TimePoint time;
  bool interrupted = false;
  std::set<std::string> unreachable;
  std::set<std::string> without_actor;
  std::set<std::string> replaced;
  std::set<std::string> killable;

  // -- what it says

  /// Commands and news, in their order.
  std::vector<std::string> log;
  std::function<void(const ComponentEnded&)> failure_handler;

  SupervisionTree tree;
  Failover failover;
  SystemModel model{tree, failover};
  TransitionScheduler scheduler{model, failover, *this, *this};

  // -- what a supervisor would tell the scheduler

  /// False if no transition takes care of it.
  bool end(const std::string& child, ComponentEnded::How how = ComponentEnded::How::failed) {
    bool was_alive = model.set_alive(child, false);
    return scheduler.ended({child, model.child(child).incarnation, how, "it failed"}, was_alive);
  }

  /// Whether the child is alive, in that life.
  bool lives(const std::string& child, std::uint64_t incarnation) const {
    auto& x = model.child(child);
    return x.alive && x.incarnation == incarnation;
  }

  void phase_done(const std::string& child, Phase phase, const std::string& failure = {}) {
    scheduler.phase_done({static_cast<std::uint32_t>(model.child(child).number), phase, failure});
  }

  /// Everything that was commanded works out, but time stands still.
  void work() {
    while (!stops.empty() || !makings.empty() || !phases.empty()) {
      for (auto& [child, incarnation] : std::exchange(stops, {}))
        if (lives(child, incarnation))
          end(child, ComponentEnded::How::stopped);
      for (auto& x : std::exchange(makings, {}))
        x.done({});
      for (auto& x : std::exchange(phases, {}))
        if (x.phase != Phase::run && lives(x.child, x.incarnation))
          phase_done(x.child, x.phase);
    }
  }

  void let_time_pass(std::chrono::milliseconds x) {
    auto until = time + x;
    for (;;) {
      auto due = reminders.end();
      for (auto i = reminders.begin(); i != reminders.end(); ++i)
        if (i->first <= until && (due == reminders.end() || i->first < due->first))
          due = i;
      if (due == reminders.end())
        break;
      auto [at, reminder] = *due;
      reminders.erase(due);
      time = std::max(time, at);
      scheduler.remind(reminder);
    }
    time = until;
  }

private:
  TimePoint now() const override { return time; }
  bool is_interrupted() const override { return interrupted; }
  bool is_reachable(const std::string& child) const override {
    return unreachable.count(child) == 0;
  }
  bool has_actor(const std::string& child) const override {
    return without_actor.count(child) == 0;
  }
  bool is_replaced(const std::string& child) const override { return replaced.count(child) > 0; }

  void remind(const TransitionReminder& of, Timestamp after) override {
    reminders.emplace_back(time + after, of);
  }

  void stop(const std::string& child) override {
    log.push_back("stop " + child);
    stops.emplace_back(child, model.child(child).incarnation);
  }

  bool kill(const std::string& child) override {
    if (killable.erase(child) == 0)
      return false;
    log.push_back("kill " + child);
    return true;
  }

  void make(const std::vector<std::string>& children, bool by_plan,
            std::function<void(const std::set<std::string>&)> done) override {
    for (auto& x : children)
      log.push_back((by_plan ? "plan " : "make ") + x);
    makings.push_back({children, by_plan, std::move(done)});
  }

  void enter(const std::string& child, Phase phase) override {
    log.push_back((phase == Phase::configure ? "configure "
                   : phase == Phase::start   ? "start "
                                             : "run ") +
                  child);
    phases.push_back({child, model.child(child).incarnation, phase});
  }

  void on_down(const std::string& child, const std::string&) override {
    log.push_back(child + " is down");
  }
  void on_up(const std::string& child) override { log.push_back(child + " is up"); }
  void on_stuck(const std::string& child, bool restarts) override {
    log.push_back(child + (restarts ? " is stuck, and not started again" : " is stuck"));
  }
  void on_slow(const std::string& child, Phase) override { log.push_back(child + " is slow"); }
  void on_change() override {}
  void on_failure(const ComponentEnded& x) override {
    log.push_back(x.name + " failed");
    if (failure_handler)
      failure_handler(x);
  }
};

} // namespace castor::test
