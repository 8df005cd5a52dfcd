#pragma once

#include "castor/actors/component/task_event.hpp"
#include "castor/actors/runtime/caller_runs.hpp"
#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/runtime/push_recorder.hpp"
#include "castor/actors/runtime/record.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// What the components of one process share; outlives the actor system, and so must keep no actor
/// alive, whose threads the actor system waits for.
struct ComponentServices {
  /// The moment that times count from.
  std::chrono::steady_clock::time_point epoch;

  /// Part of the ids that components make, where entries outlive the system: nobody else's number.
  /// 0 where they do not.
  std::atomic<std::uint64_t> run{0};

  /// The working memories of this process, sorted by address: the last list is that of now. A list
  /// never changes, since components' threads look at the one that there was when they were made.
  std::deque<std::vector<caf::resumable*>> working_memories;

  /// A working memory still knows the last component that ran it after that component is gone, so
  /// these stay until the end.
  std::vector<std::unique_ptr<CallerRuns>> units;

  /// Where operations are written down; null where they are not.
  std::unique_ptr<OperationLog> operations;

  /// Records what stand-alone components hand out; null where that is not recorded.
  std::unique_ptr<PushRecorder> pushes;

  /// Called from any component's thread when it wants the system to end.
  std::function<void(int status, const std::string& reason)> end_system;

  /// Called from task managers' threads, if anybody watches.
  std::function<void(TaskEvent)> on_task;
};

} // namespace castor
