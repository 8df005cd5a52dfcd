#pragma once

#include "castor/actors/component/task.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace castor {

/// Events in the life of a proposed task.
enum class TaskStep : std::uint8_t { adopted, rejected, waiting, retracted, completed };

/// "ADOPTED", "REJECTED", "WAITING", "RETRACTED" or "COMPLETED".
std::string_view to_string(TaskStep x);

/// Event of a task, for observers of a system.
struct TaskEvent {
  TaskStep step = TaskStep::adopted;
  std::string subarchitecture;
  TaskProposal task;
  /// Reason, if one was given; of a completed task, its outcome.
  std::string detail;
  Timestamp time{0};
};

} // namespace castor
