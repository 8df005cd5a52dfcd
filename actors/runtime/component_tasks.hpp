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

/// Connection between a managed component and its task manager, at either end.
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

  /// Whether the component is a task manager, which receives the ends of components whose tasks it
  /// has.
  bool is_manager() const { return manager_ != nullptr; }

  /// Handles the message if it concerns tasks; otherwise returns false.
  bool handle(caf::mailbox_element& x);

  void clear();

private:
  const caf::actor& task_manager() const;
  bool handle_managed(caf::mailbox_element& x);
  bool handle_manager(caf::mailbox_element& x);
  void handle_end(const caf::down_msg& x);

  Parts parts_;
  ManagedComponent* managed_;
  TaskManager* manager_;
  std::map<TaskId, caf::actor> proposers_;
  /// Components that this task manager monitors.
  std::set<caf::actor_addr> watched_;
};

} // namespace castor
