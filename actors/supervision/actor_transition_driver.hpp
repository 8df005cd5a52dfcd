#pragma once

#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/supervision/deployment.hpp"
#include "castor/actors/supervision/failover.hpp"
#include "castor/actors/supervision/system_model.hpp"
#include "castor/actors/supervision/transition_driver.hpp"

#include <caf/event_based_actor.hpp>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// Carries out the commands of transitions with messages to the actors of children, and to the
/// agents of the processes that make them.
class ActorTransitionDriver : public TransitionDriver {
public:
  /// All of them have to outlive it. `plan` returns the current plan of the system. `clock` is null
  /// for the real one.
  ActorTransitionDriver(caf::event_based_actor* self, const Processes& processes,
                        const SystemOptions& options, const SystemModel& model,
                        const Failover& failover, Deployments& deployments,
                        std::function<PartPlan()> plan, std::shared_ptr<SimulatedClock> clock)
    : self_(self), processes_(processes), options_(options), model_(model), failover_(failover),
      deployments_(deployments), plan_(std::move(plan)), clock_(std::move(clock)) {}

  TimePoint now() const override { return self_->clock().now(); }
  bool is_interrupted() const override { return options_.interrupted && options_.interrupted(); }
  bool is_reachable(const std::string& child) const override;
  bool has_actor(const std::string& child) const override { return actor_of(child) != nullptr; }
  bool is_replaced(const std::string& child) const override;

  void remind(const TransitionReminder& of, Timestamp after) override;
  void delay(const TransitionReminder& of, Timestamp by) override;
  void stop(const std::string& child) override;
  bool kill(const std::string& child) override;
  void make(const std::vector<std::string>& children, bool by_plan,
            std::function<void(const std::set<std::string>& failed)> done) override;
  void enter(const std::string& child, Phase phase) override;

  /// Injects the fault when the component is configured or started next.
  void inject_in_next_life(const InjectComponentFault& x);

  /// Whether the child has a process of its own that can be killed.
  bool has_own_process(const std::string& child) const;
  /// False if the child has no process of its own, or that has ended already.
  bool kill_process_of(const std::string& child) const;

private:
  caf::actor actor_of(const std::string& child) const;
  void make_by_plan(const std::vector<std::string>& children,
                    std::function<void(const std::set<std::string>&)> done);
  void make_one_by_one(const std::vector<std::string>& children,
                       std::function<void(const std::set<std::string>&)> done);

  caf::event_based_actor* self_;
  const Processes& processes_;
  const SystemOptions& options_;
  const SystemModel& model_;
  const Failover& failover_;
  Deployments& deployments_;
  std::function<PartPlan()> plan_;
  /// Null for the real clock.
  std::shared_ptr<SimulatedClock> clock_;
  /// Actors the last phase commands were sent to, by the names of the children.
  std::map<std::string, caf::actor_addr> commanded_;
  std::map<std::pair<std::string, Phase>, ComponentFault> next_life_faults_;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::TransitionReminder)
