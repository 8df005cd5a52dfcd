#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Messages between managed components and their task manager.
namespace castor {

/// Id of a proposed task; unique in the system.
using TaskId = std::string;

/// Scheduling options of a task.
struct TaskOptions {
  /// Of the tasks that could be adopted, those of higher priority come first.
  int priority = 0;
  /// Part of the task manager's budget that the task occupies while it is under way.
  double cost = 1;
  /// Tasks of the same subarchitecture that have to succeed first, whoever proposes them.
  std::vector<TaskId> after = {};
};

/// Task that a managed component proposes.
struct TaskProposal {
  TaskId id;
  /// Description of the task, for the task manager's rules and for people.
  std::string name;
  std::string component;
  TaskOptions options = {};
};

enum class TaskDecision : std::uint8_t { adopted, rejected, waiting };
CASTOR_REFLECT_ENUM(TaskDecision, adopted, rejected, waiting)

/// The task manager's answer.
struct TaskDecided {
  TaskId id;
  TaskDecision decision = TaskDecision::adopted;
  /// Why the task waits or is rejected, as a clause that follows "It is rejected: ".
  std::string reason = {};
};

enum class TaskOutcome : std::uint8_t { success, failure, incomplete };
CASTOR_REFLECT_ENUM(TaskOutcome, success, failure, incomplete)

} // namespace castor
