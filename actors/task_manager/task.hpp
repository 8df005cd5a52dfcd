#pragma once

#include "castor/wm/reflect.hpp"

#include <cstdint>
#include <string>

/// What managed components and their task manager say to each other.
namespace castor {

/// Names a proposed task; unique in the system.
using TaskId = std::string;

/// A managed component asks whether it may do something.
struct TaskProposal {
  TaskId id;
  /// What is to be done, for the task manager's rules and for people.
  std::string name;
  std::string component;
};

enum class TaskDecision : std::uint8_t { adopted, rejected, waiting };
CASTOR_REFLECT_ENUM(TaskDecision, adopted, rejected, waiting)

enum class TaskOutcome : std::uint8_t { success, failure, incomplete };
CASTOR_REFLECT_ENUM(TaskOutcome, success, failure, incomplete)

} // namespace castor
