#include "castor/actors/registry.hpp"

namespace castor {

namespace {

/// Adopts every task as soon as it is proposed, in the order of proposal.
class AlwaysPositiveTaskManager final : public TaskManager {
  void task_proposed(const TaskProposal& task) override {
    debug("adopts {} of {}: {}", task.id, task.component, task.name);
    decide(task.id, TaskDecision::adopted);
  }
};

CASTOR_COMPONENT(AlwaysPositiveTaskManager, "adopts every task that is proposed, at once")

} // namespace

} // namespace castor
