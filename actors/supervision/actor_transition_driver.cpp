#include "castor/actors/supervision/actor_transition_driver.hpp"

#include "castor/base/log.hpp"

#include <chrono>
#include <cstddef>

namespace castor {

bool ActorTransitionDriver::is_reachable(const std::string& child) const {
  return processes_.is_up(failover_.process_of(child));
}

bool ActorTransitionDriver::is_replaced(const std::string& child) const {
  auto i = commanded_.find(child);
  return i == commanded_.end() || i->second != actor_of(child).address();
}

caf::actor ActorTransitionDriver::actor_of(const std::string& child) const {
  auto i = deployments_.actors().find(child);
  return i == deployments_.actors().end() ? nullptr : caf::actor_cast<caf::actor>(i->second);
}

void ActorTransitionDriver::remind(const TransitionReminder& of, Timestamp after) {
  self_->delayed_send(self_, after, of);
}

void ActorTransitionDriver::delay(const TransitionReminder& of, Timestamp by) {
  auto reminder = of;
  if (clock_)
    reminder.hold = std::make_shared<TimeHold>(clock_->hold());
  remind(reminder, by);
}

void ActorTransitionDriver::stop(const std::string& child) {
  if (auto actor = actor_of(child))
    self_->send_exit(actor, caf::exit_reason::user_shutdown);
}

bool ActorTransitionDriver::kill(const std::string& child) {
  if (!kill_process_of(child))
    return false;
  log_runtime(LogLevel::error, child,
              "did not stop: it has not returned from its own code; its process is killed");
  return true;
}

bool ActorTransitionDriver::has_own_process(const std::string& child) const {
  return model_.child(child).isolated && options_.kill_child;
}

bool ActorTransitionDriver::kill_process_of(const std::string& child) const {
  return has_own_process(child) && options_.kill_child(model_.architecture().component(child)->host,
                                                       std::chrono::steady_clock::now());
}

void ActorTransitionDriver::make(const std::vector<std::string>& children, bool by_plan,
                                 std::function<void(const std::set<std::string>&)> done) {
  if (by_plan)
    make_by_plan(children, std::move(done));
  else
    make_one_by_one(children, std::move(done));
}

void ActorTransitionDriver::make_by_plan(const std::vector<std::string>& children,
                                         std::function<void(const std::set<std::string>&)> done) {
  Deployments::Order order;
  order.plan = plan_;
  order.done = [children, done](const Deployments::Problems& problems) {
    if (problems.empty())
      return done({});
    log_runtime(LogLevel::error, "supervisor", render(problems));
    done({children.begin(), children.end()});
  };
  deployments_.add(std::move(order));
}

void ActorTransitionDriver::make_one_by_one(
  const std::vector<std::string>& children,
  std::function<void(const std::set<std::string>&)> done) {
  auto missing = std::make_shared<std::size_t>(children.size());
  auto failed = std::make_shared<std::set<std::string>>();
  auto answered = [missing, failed, done] {
    if (--*missing == 0)
      done(*failed);
  };
  for (auto& name : children)
    self_
      ->request(processes_.agent(failover_.process_of(name)), options_.part_patience,
                RestartComponent{name, model_.child(name).incarnation})
      .then(
        [this, name, failed, answered](const PartMade& x) {
          if (auto actor = x.actors.find(name); actor != x.actors.end())
            deployments_.set_actor(name, actor->second);
          else
            failed->insert(name);
          answered();
        },
        [name, failed, answered](const caf::error&) {
          failed->insert(name);
          answered();
        });
}

void ActorTransitionDriver::enter(const std::string& child, Phase phase) {
  auto actor = actor_of(child);
  commanded_[child] = actor.address();
  if (auto fault = next_life_faults_.extract({child, phase}))
    self_->send(actor, fault.mapped());
  self_->send(actor, EnterPhase{phase, caf::actor_cast<caf::actor>(self_)});
}

void ActorTransitionDriver::inject_in_next_life(const InjectComponentFault& x) {
  auto phase =
    x.fault.kind == ComponentFault::Kind::blocked_configure ? Phase::configure : Phase::start;
  next_life_faults_[{x.name, phase}] = x.fault;
}

} // namespace castor
