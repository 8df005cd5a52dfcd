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

/// What has become of a recording that was replayed.
struct ReplayOutcome {
  std::uint64_t writes = 0;
  /// Writes that came to nothing, because what they were to change is not there.
  std::uint64_t skipped = 0;
  std::uint64_t refused = 0;
  /// Values that were handed out in the name of stand-alone components.
  std::uint64_t values = 0;
  /// Why the first write was refused, or why there was no more.
  std::string problem;
};

struct ReplayProgress {
  ReplayOutcome outcome;
  /// Where it is in the recording.
  UnixTime at{0};
  bool paused = false;
  /// From 1.
  std::uint64_t round = 1;
};

/// To a replay.
enum class ReplayControl : std::uint8_t {
  pause,
  go_on,
  /// It is over, as if there were no more.
  end,
};

struct ReplayParts {
  RecordingSelection selection;
  std::map<std::string, WorkingMemoryActor> working_memories;
  /// Those that stand in for the recorded ones.
  std::map<std::string, caf::actor> providers;
  /// 1 is as it was, 2 is twice as fast; 0 is as fast as it can be.
  double speed = 1;
  /// What was recorded at this time or later is left out; 0 for nothing.
  UnixTime to{0};
  /// The replay lasts until then, also if there is nothing to do any more; 0 for no longer than
  /// that.
  UnixTime end{0};
  /// How often; 0 for as often as it can be. In between, the entries that it has added are removed.
  std::uint64_t rounds = 1;
  /// Called some times a second, if anybody wants to know.
  std::function<void(const ReplayProgress&)> on_progress;
  std::function<void(const ReplayOutcome&)> done;
};

/// Makes the changes of a recording again, in the names of those who made them, each at its time.
/// An entry that is not there is added, one that is there is overwritten, whatever its version.
/// Understands ReplayControl.
caf::behavior replay(caf::event_based_actor* self, std::shared_ptr<ReplayParts> parts);

/// Lets the stand-ins of recorded stand-alone components hand out what there was at `from`, before
/// anybody asks. Throws JournalError.
void hand_out_first_values(const SystemRoster& roster,
                           const std::vector<std::filesystem::path>& pushes, UnixTime from);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::ReplayControl)
