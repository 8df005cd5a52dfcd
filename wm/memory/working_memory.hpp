#pragma once

#include "castor/wm/memory/working_memory_options.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <memory>

namespace castor {

class WorkingMemoryShell;

struct WorkingMemoryState {
  static constexpr const char* name = "working_memory";

  /// Destroyed with the actor, which also ends deferred replies.
  std::shared_ptr<WorkingMemoryShell> shell;
};

/// The working memory of one subarchitecture.
WorkingMemoryActor::behavior_type
working_memory(WorkingMemoryActor::stateful_pointer<WorkingMemoryState> self,
               WorkingMemoryOptions options);

} // namespace castor
