#include "castor/actors/component/registry.hpp"

namespace castor {

namespace {

/// Adopts every task as soon as it is proposed, in the order of proposal.
class AlwaysPositiveTaskManager final : public TaskManager {
  void task_proposed(const TaskProposal& task) override { decide(task.id, TaskDecision::adopted); }
};

CASTOR_COMPONENT(AlwaysPositiveTaskManager, "adopts every task that is proposed, at once")

} // namespace

} // namespace castor
