#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/runtime/status.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <string>
#include <vector>

namespace castor {

/// A process, and what it has exchanged with the others.
struct ProcessSummary {
  ProcessDescription description;
  ProcessUsage usage;
  std::vector<LinkStatus> links;
};

struct SystemSummary {
  /// The coordinator's first; those that are in reach.
  std::vector<ProcessSummary> processes;
  /// Those that are in reach, in the order of the file.
  std::vector<WorkingMemoryStatus> working_memories;
  /// In the order of their start.
  std::vector<ComponentStatus> components;
  /// Components of this process that did not stop when they were told to; their threads are still
  /// running, so the process has to leave without destroying the system: see `System::abandon`.
  std::vector<std::string> stuck;
  /// Components of any process that did not stop when the system did, with those whose processes
  /// had to be killed for that.
  std::vector<std::string> unstopped;
};

} // namespace castor
