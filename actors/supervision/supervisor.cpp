#include "castor/actors/supervision/supervisor.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/supervision/actor_transition_driver.hpp"
#include "castor/actors/supervision/deployment.hpp"
#include "castor/actors/supervision/failover.hpp"
#include "castor/actors/supervision/health_log.hpp"
#include "castor/actors/supervision/supervision_tree.hpp"
#include "castor/actors/supervision/system_model.hpp"
#include "castor/actors/supervision/transition_scheduler.hpp"
#include "castor/base/log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <random>
#include <utility>

namespace castor {

/// To the supervisor from itself: is that component still without its working memory?
struct OrphanDue {
  std::string name;
  std::uint64_t incarnation = 0;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::OrphanDue)

namespace castor {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How long a component may wait for the news that its working memory has ended, too.
constexpr auto orphan_patience = 1s;

class Supervisor : public std::enable_shared_from_this<Supervisor>, private TransitionObserver {
public:
  Supervisor(caf::event_based_actor* self, SupervisorParts parts)
    : self_(self), parts_(std::move(parts)), processes_(*parts_.processes),
      options_(*parts_.options),
      deployments_(std::make_shared<Deployments>(self, processes_, options_.part_patience)),
      health_(self, *deployments_, options_),
      tree_(parts_.seed ? *parts_.seed : std::random_device{}()), model_(tree_, failover_),
      driver_(
        self, processes_, options_, model_, failover_, *deployments_, [this] { return plan(); },
        parts_.clock),
      transitions_(model_, failover_, driver_, *this) {}

  caf::behavior begin() {
    auto me = shared_from_this();
    return {
      [me](const Deploy& x) { return me->deploy(x); },
      [me](const StartComponents& x) { return me->start(x.names); },
      [me](const StopComponents& x) { return me->stop(x.names); },
      [me](const PhaseDone& x) { me->transitions_.phase_done(x); },
      [me](const ComponentEnded& x) { me->ended(x); },
      [me](const ComponentHangs& x) { me->end_hanging(x); },
      [me](const InjectComponentFault& x) { me->driver_.inject_in_next_life(x); },
      [me](const LinkNews& x) { me->on_link_news(x); },
      [me](const TransitionReminder& x) { me->transitions_.remind(x); },
      [me](const OrphanDue& x) { me->check_orphan(x); },
    };
  }

private:
  Timestamp age() const {
    return std::chrono::duration_cast<Timestamp>(self_->clock().now() - parts_.epoch);
  }

  // -- requests

  caf::response_promise deploy(const Deploy& x) {
    auto promise = self_->make_response_promise();
    Deployments::Order order;
    order.wait_for_all = true;
    order.plan = [this, x] {
      failover_.set(x.placement);
      tree_.set(x.architecture, options_.restarts);
      model_.set(x.architecture, options_.stop_patience);
      health_.forget_others(x.architecture);
      return plan();
    };
    order.done = [this, promise](const Deployments::Problems& problems) mutable {
      publish();
      promise.deliver(Deployed{problems});
    };
    deployments_->add(std::move(order));
    return promise;
  }

  caf::response_promise start(const std::vector<std::string>& names) {
    auto promise = self_->make_response_promise();
    TransitionRequest request;
    request.start = model_.in_order(names);
    request.done = [promise](const TransitionResult& x) mutable {
      promise.deliver(ComponentsStarted{x.problems});
    };
    transitions_.begin(std::move(request));
    return promise;
  }

  caf::response_promise stop(const std::vector<std::string>& names) {
    auto promise = self_->make_response_promise();
    TransitionRequest request;
    request.stop = model_.in_order(names);
    request.done = [promise](const TransitionResult& x) mutable {
      promise.deliver(ComponentsStopped{x.stopped, x.stuck});
    };
    transitions_.stop(std::move(request));
    return promise;
  }

  // -- what others are told

  PartPlan plan() const {
    auto result = model_.plan();
    result.system = processes_.name();
    result.processes = processes_.descriptions();
    result.open_access = options_.open_access;
    result.broadcast = options_.broadcast;
    result.coordinator = parts_.end_listener;
    result.supervisor = caf::actor_cast<caf::actor>(self_);
    result.task_observer = parts_.task_observer;
    result.operations = options_.operations.string();
    result.pushes = options_.pushes.string();
    result.pushes_limit = options_.pushes_limit;
    result.age = age();
    result.simulated_clock = parts_.clock != nullptr;
    if (parts_.clock)
      result.clock = parts_.clock->present();
    result.patience = options_.link.patience;
    return result;
  }

  void publish() {
    auto roster = model_.roster(deployments_->actors());
    roster.file = parts_.file;
    roster.epoch = parts_.epoch;
    roster.processes = processes_.descriptions();
    for (std::size_t i = 0; i < roster.processes.size(); ++i)
      roster.agents.push_back(processes_.agent(static_cast<ProcessNumber>(i)));
    parts_.on_change(std::make_shared<const SystemRoster>(std::move(roster)));
  }

  /// The others are to know how things stand.
  void tell_plan() {
    Deployments::Order order;
    order.plan = [this] { return plan(); };
    order.done = [this](const Deployments::Problems&) {
      publish();
      transitions_.resume();
    };
    deployments_->add(std::move(order));
  }

  // -- news of transitions

  void on_down(const std::string& child, const std::string& reason) override {
    health_.down(subject(child), reason, true);
  }

  void on_up(const std::string& child) override { health_.up(subject(child)); }

  void on_stuck(const std::string& child, bool restarts) override {
    log_runtime(LogLevel::error, child, "did not stop: it has not returned from its own code");
    if (restarts)
      health_.down(subject(child), "it did not stop, and is not started again", false);
  }

  void on_slow(const std::string& child, Phase phase) override {
    log_runtime(LogLevel::info, "supervisor",
                fmt::format("waiting for {} to {}", child,
                            phase == Phase::configure ? "configure" : "start"));
  }

  void on_change() override { publish(); }

  void on_failure(const ComponentEnded& x) override { handle_failure(x); }

  // -- failures

  /// The child, if it lives this life and has not been given up.
  const SupervisedChild* find(const std::string& name, std::uint64_t incarnation) const {
    auto* child = model_.find(name);
    return child && child->incarnation == incarnation && !child->given_up ? child : nullptr;
  }

  void ended(const ComponentEnded& x) {
    auto* child = model_.find(x.name);
    if (!child || child->incarnation != x.incarnation)
      return;
    bool was_alive = model_.set_alive(x.name, false);
    if (!transitions_.ended(x, was_alive) && was_alive)
      handle_failure(x);
  }

  /// A child has ended, and no transition has to do with that.
  void handle_failure(const ComponentEnded& x) {
    auto* child = find(x.name, x.incarnation);
    if (!child || child->alive || transitions_.is_scheduled(x.name))
      return;
    if (x.how == ComponentEnded::How::orphaned) {
      // It is started again with its working memory, of whose end we have heard or will.
      self_->delayed_send(self_, orphan_patience, OrphanDue{x.name, x.incarnation});
      return;
    }
    auto decision = x.how == ComponentEnded::How::stopped ? tree_.ended(x.name, age())
                    : is_coming_back(x.waited_for)        ? tree_.failed_without(x.name, age())
                                                          : tree_.failed(x.name, age());
    auto reason = x.how == ComponentEnded::How::stopped ? "ended with its work done" : x.failure;
    switch (decision.kind) {
      case SupervisionDecision::Kind::leave:
        model_.set_given_up(x.name, true);
        report_failure(x, reason, false);
        publish();
        return;
      case SupervisionDecision::Kind::give_up:
        end_system(decision, x.name, reason);
        return;
      case SupervisionDecision::Kind::restart:
        report_failure(x, reason, true);
        restart(decision, x.name);
        return;
    }
  }

  /// Whether somebody is there, or will be: whoever waits for one that will not be has failed.
  bool is_coming_back(const std::string& name) const {
    auto* child = model_.find(name);
    return child && !child->given_up;
  }

  /// It has gone too far.
  void end_system(const SupervisionDecision& decision, const std::string& name,
                  const std::string& reason) {
    health_.down(subject(name), reason, false);
    caf::anon_send(parts_.end_listener,
                   EndSystem{1, "the supervisor: " + decision.reason + "; " + name + ' ' + reason});
  }

  /// The watchdog has found one that does not come back. Only a process of its own can be ended.
  void end_hanging(const ComponentHangs& x) {
    auto* child = find(x.name, x.incarnation);
    if (!child || !driver_.has_own_process(x.name))
      return;
    log_runtime(LogLevel::warning, x.name, "hangs; its process is killed");
    driver_.kill_process_of(x.name);
  }

  void check_orphan(const OrphanDue& x) {
    // Its working memory still is there, so it has failed as anybody may.
    auto* child = model_.find(x.name);
    if (!child)
      return;
    auto* wm = model_.find(working_memory_of(child->subarchitecture));
    if (wm && wm->alive)
      handle_failure({x.name, x.incarnation, ComponentEnded::How::failed,
                      "its working memory could not be reached"});
  }

  void restart(const SupervisionDecision& decision, const std::string& name) {
    if (!decision.escalated.empty())
      log_runtime(LogLevel::error, "supervisor",
                  fmt::format("{} fails as a whole and is started again: {}", decision.escalated,
                              decision.reason));
    TransitionRequest request;
    request.remakes = true;
    request.delay = decision.delay;
    auto is_here = [&](const std::string& x) {
      auto* child = model_.find(x);
      return child && (!child->given_up || !decision.escalated.empty()) &&
             !failover_.is_awaited(x) &&
             processes_.state(failover_.process_of(x)).link != LinkState::lost;
    };
    std::copy_if(decision.stop.begin(), decision.stop.end(), std::back_inserter(request.stop),
                 is_here);
    std::copy_if(decision.start.begin(), decision.start.end(), std::back_inserter(request.start),
                 is_here);
    for (auto& x : request.start)
      model_.set_given_up(x, false);
    request.reason = "it is started again because of " + name;
    for (auto& x : request.stop)
      on_down(x, request.reason);
    publish();
    transitions_.begin(std::move(request));
  }

  HealthLog::Subject subject(const std::string& name) const {
    auto& child = model_.child(name);
    return {name, child.subarchitecture, child.incarnation, false};
  }

  /// Of one that has failed in its own code, which it has logged where it ran.
  void report_failure(const ComponentEnded& x, const std::string& reason, bool will_restart) {
    auto failed = subject(x.name);
    failed.reports_itself = x.how == ComponentEnded::How::failed &&
                            failover_.process_of(x.name) == 0 &&
                            model_.child(x.name).kind != ComponentKind::working_memory;
    health_.down(failed, reason, will_restart);
  }

  // -- processes

  /// A process that this one has started, and that is lost though it has not ended: it is stopped,
  /// or has no connections any more. Another one will take its place.
  void end_lost_child(ProcessNumber lost) {
    if (!options_.kill_child)
      return;
    for (auto& [host, process] : failover_.placement().hosts)
      if (process == lost && options_.kill_child(host, processes_.last_up(lost)))
        log_runtime(LogLevel::warning, processes_.state(lost).description.name,
                    "does not answer; its process is killed");
  }

  void on_link_news(const LinkNews& x) {
    if (x.state == LinkState::lost)
      lose(x.peer, x.reason);
    if (x.state == LinkState::up)
      if (auto awaited = failover_.take_awaited(x.peer)) {
        log_runtime(LogLevel::info, "supervisor", "node " + x.name + " was started again");
        bring_back(*awaited);
      }
    // Who was out of reach has missed something; the others do not know yet who is lost.
    if (deployments_->update_reachability() || x.state == LinkState::lost)
      tell_plan();
  }

  void lose(ProcessNumber lost, const std::string& why) {
    end_lost_child(lost);
    Failover::Awaited awaited;
    std::vector<std::string> affected;
    for (auto& name : tree_.order())
      if (!model_.child(name).given_up && failover_.process_of(name) == lost &&
          survives_loss(name,
                        "its node " + processes_.state(lost).description.name + " is lost: " + why,
                        awaited.decision))
        affected.push_back(name);
    auto loss = failover_.lose(lost, affected, model_.architecture(),
                               [this](ProcessNumber x) { return processes_.is_up(x); });
    awaited.names = std::move(loss.left);
    if (loss.needs_successor)
      failover_.set_successor(lost, processes_.look_for_successor(lost), std::move(awaited));
    transitions_.lose(affected);
    publish();
    if (!loss.moved.empty())
      move(loss.moved, "the loss of its node");
  }

  /// Whether a child whose process was lost is to go on elsewhere. If the loss was its own failure,
  /// sets what is to be done about that.
  bool survives_loss(const std::string& name, const std::string& reason,
                     std::optional<SupervisionDecision>& decision) {
    bool was_alive = model_.set_alive(name, false);
    // One that was killed because it did not stop goes on as one that has stopped.
    bool was_killed = model_.set_killed(name, false);
    bool given_up = !was_killed && tree_.restart_type(name) == RestartType::temporary;
    // The loss of a node is nobody's failure, but that of a component's own process is.
    if (was_alive && !was_killed && !given_up && driver_.has_own_process(name)) {
      decision = tree_.failed(name, age());
      if (decision->kind == SupervisionDecision::Kind::give_up) {
        model_.set_given_up(name, true);
        end_system(*decision, name, reason);
        return false;
      }
    }
    model_.set_given_up(name, given_up);
    health_.down(subject(name), reason, !given_up);
    return !given_up;
  }

  /// These are to run in other processes from now on, which takes others with it.
  void move(const std::vector<std::string>& names, const std::string& why) {
    SupervisionDecision decision{SupervisionDecision::Kind::restart};
    decision.stop = tree_.with_dependents(names);
    std::copy_if(decision.stop.begin(), decision.stop.end(), std::back_inserter(decision.start),
                 [&](auto& x) {
                   auto restart = tree_.restart_type(x) != RestartType::temporary;
                   return restart || std::ranges::count(names, x) > 0;
                 });
    failover_.begin_move(names);
    restart(decision, why);
  }

  void bring_back(const Failover::Awaited& x) {
    if (!x.decision)
      return move(x.names, "the return of its node");
    failover_.begin_move(x.names);
    restart(*x.decision, x.names.front());
  }

  caf::event_based_actor* self_;
  const SupervisorParts parts_;
  Processes& processes_;
  const SystemOptions& options_;
  std::shared_ptr<Deployments> deployments_;
  HealthLog health_;
  SupervisionTree tree_;
  Failover failover_;
  SystemModel model_;
  ActorTransitionDriver driver_;
  TransitionScheduler transitions_;
};

} // namespace

caf::behavior supervisor(caf::event_based_actor* self, SupervisorParts parts) {
  return std::make_shared<Supervisor>(self, std::move(parts))->begin();
}

} // namespace castor
