#pragma once

#include "castor/actors/supervision/roster.hpp"
#include "castor/actors/system/recording.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <caf/event_based_actor.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace castor {

/// Result of a replay.
struct ReplayOutcome {
  std::uint64_t writes = 0;
  /// Writes without effect, because their entries are not there.
  std::uint64_t skipped = 0;
  std::uint64_t refused = 0;
  /// Values that were handed out in the name of stand-alone components.
  std::uint64_t values = 0;
  /// Why the first write was refused, or why the replay ended early.
  std::string problem;
};

struct ReplayProgress {
  ReplayOutcome outcome;
  /// Position in the recording.
  UnixTime at{0};
  bool paused = false;
  /// From 1.
  std::uint64_t round = 1;
};

/// To a replay.
enum class ReplayControl : std::uint8_t {
  pause,
  go_on,
  /// Ends the replay, as at the end of the recording.
  end,
};

struct ReplayParts {
  RecordingSelection selection;
  std::map<std::string, WorkingMemoryActor> working_memories;
  /// Stand-ins of the recorded stand-alone components.
  std::map<std::string, caf::actor> providers;
  /// 1 is the original speed, 2 is twice as fast; 0 is as fast as possible.
  double speed = 1;
  /// What was recorded at this time or later is left out; 0 for nothing.
  UnixTime to{0};
  /// The replay lasts until this time even if there are no more steps; 0 to end with the last step.
  UnixTime end{0};
  /// Number of rounds; 0 for no limit. In between, the entries that it has added are removed.
  std::uint64_t rounds = 1;
  /// Called several times a second; may be empty.
  std::function<void(const ReplayProgress&)> on_progress;
  std::function<void(const ReplayOutcome&)> done;
};

/// Makes the changes of a recording again, with their original sources, each at its time. An entry
/// that is not there is added, one that is there is overwritten, whatever its version. Understands
/// ReplayControl.
caf::behavior replay(caf::event_based_actor* self, std::shared_ptr<ReplayParts> parts);

/// Sends the stand-ins of recorded stand-alone components their values at `from`, before the first
/// pull. Throws JournalError.
void hand_out_first_values(const SystemRoster& roster,
                           const std::vector<std::filesystem::path>& pushes, UnixTime from);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::ReplayControl)
