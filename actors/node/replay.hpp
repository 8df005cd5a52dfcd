#pragma once

#include "castor/actors/node/recording.hpp"
#include "castor/wm/working_memory_protocol.hpp"

#include <caf/event_based_actor.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace castor {

/// What has become of a recording that was replayed.
struct ReplayOutcome {
  std::uint64_t writes = 0;
  /// Writes that came to nothing, because what they were to change is not there.
  std::uint64_t skipped = 0;
  std::uint64_t refused = 0;
  /// Why the first of them was, or why there was no more.
  std::string problem;
};

struct ReplayParts {
  std::unique_ptr<Recording> recording;
  std::map<std::string, WorkingMemoryActor> working_memories;
  /// 1 is as it was, 2 is twice as fast; 0 is as fast as it can be.
  double speed = 1;
  std::function<void(const ReplayOutcome&)> done;
};

/// Makes the changes of a recording again, in the names of those who made them, each at its time.
/// An entry that is not there is added, one that is there is overwritten, whatever its version.
caf::behavior replay(caf::event_based_actor* self, std::shared_ptr<ReplayParts> parts);

} // namespace castor
