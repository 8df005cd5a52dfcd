#pragma once

#include "castor/actors/component/task_link.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/user_code.hpp"

#include <map>
#include <set>

namespace castor {

class Component;
class ManagedComponent;
class TaskManager;

/// What a managed component and its task manager say to each other, at either end.
class ComponentTasks final : public TaskLink {
public:
  struct Parts {
    PumpedActor& actor;
    ComponentContext& context;
    InjectedFaults& faults;
    UserCode& code;
  };

  ComponentTasks(Component& component, const Parts& parts);

  void propose(const TaskProposal& task) override;
  void retract(const TaskId& id) override;
  void complete(const TaskId& id, TaskOutcome outcome) override;
  void decide(const TaskDecided& x) override;
  void report(const TaskEvent& event) override;

  /// Whether the component is a task manager, which is told of the end of those that it has tasks
  /// of.
  bool is_manager() const { return manager_ != nullptr; }

  /// Carries out what the message asks for, if it is about tasks; false if it is not.
  bool work_off(caf::mailbox_element& x);

  void clear();

private:
  const caf::actor& task_manager() const;
  bool work_off_managed(caf::mailbox_element& x);
  bool work_off_manager(caf::mailbox_element& x);
  void work_off_end(const caf::down_msg& x);

  Parts parts_;
  ManagedComponent* managed_;
  TaskManager* manager_;
  std::map<TaskId, caf::actor> proposers_;
  /// Components whose end this task manager will be told.
  std::set<caf::actor_addr> watched_;
};

} // namespace castor
