#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// What managed components and their task manager say to each other.
namespace castor {

/// Names a proposed task; unique in the system.
using TaskId = std::string;

/// What a scheduling task manager goes by.
struct TaskOptions {
  /// Of the tasks that could be adopted, those of higher priority come first.
  int priority = 0;
  /// What it takes of the task manager's budget while it is under way.
  double cost = 1;
  /// Tasks of the same subarchitecture that have to succeed first, whoever proposes them.
  std::vector<TaskId> after = {};
};

/// A managed component asks whether it may do something.
struct TaskProposal {
  TaskId id;
  /// What is to be done, for the task manager's rules and for people.
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
  /// Why the task waits or is rejected, as the rest of the sentence "It is rejected: ...".
  std::string reason = {};
};

enum class TaskOutcome : std::uint8_t { success, failure, incomplete };
CASTOR_REFLECT_ENUM(TaskOutcome, success, failure, incomplete)

} // namespace castor
