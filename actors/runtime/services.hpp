#pragma once

#include "castor/actors/component/task_event.hpp"
#include "castor/actors/runtime/caller_runs.hpp"
#include "castor/actors/runtime/component_pool.hpp"
#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/runtime/push_recorder.hpp"
#include "castor/actors/runtime/readable_memories.hpp"
#include "castor/actors/runtime/record.hpp"
#include "castor/wm/clock/simulated_clock.hpp"
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
  /// Time origin of the system.
  std::chrono::steady_clock::time_point epoch;

  /// Null if the clock is the real one.
  std::shared_ptr<SimulatedClock> clock;

  /// Unique number of this run, part of the ids that components make, if entries outlive the
  /// system; otherwise 0.
  std::atomic<std::uint64_t> run{0};

  /// The working memories of this process, sorted by address: the last list is that of now. A list
  /// never changes, since components' threads look at the one that there was when they were made.
  std::deque<std::vector<caf::resumable*>> working_memories;

  /// Those of them whose entries components read without a message.
  ReadableMemories readable_memories;

  /// A working memory refers to the unit that ran it last even after that component is gone, so
  /// these stay until the end.
  std::vector<std::unique_ptr<CallerRuns>> units;

  /// Runs the components that have no threads of their own.
  std::shared_ptr<ComponentPool> pool;

  /// Every event is sent to every component, which filters for itself, as in the first version of
  /// the original.
  bool broadcast = false;

  /// Operation log, or null.
  std::unique_ptr<OperationLog> operations;

  /// Recorder of the values that stand-alone components hand out, or null.
  std::unique_ptr<PushRecorder> pushes;

  /// Called from any component's thread when it wants the system to end.
  std::function<void(int status, const std::string& reason)> end_system;

  /// Called from task managers' threads; may be empty.
  std::function<void(TaskEvent)> on_task;
};

} // namespace castor
