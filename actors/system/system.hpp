#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/system/run_limits.hpp"
#include "castor/actors/system/system_summary.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor {

struct SystemRoster;
using SystemRosterPtr = std::shared_ptr<const SystemRoster>;

class FaultPort;

/// A whole architecture: its coordinator, and the part of it that runs in this process. The rest
/// runs on nodes, as the architecture says.
///
///     System system{architecture};
///     system.start();
///     system.wait({.at_most = 10s});
///     system.stop();
///
/// Made, used and destroyed on one thread.
class System {
public:
  /// Throws SystemError if the architecture names classes, options or hosts that do not exist, or
  /// nodes that cannot be reached; then nothing of it is left anywhere.
  explicit System(ArchitectureDescription architecture, SystemOptions options = {});
  System(const System&) = delete;
  System& operator=(const System&) = delete;
  /// Stops what was not stopped.
  ~System();

  /// Configures every component, then starts every component, then lets them run. False if it was
  /// interrupted. Throws SystemError if a configure() fails, because the configuration is wrong
  /// then; nothing was started. All other failures are handled by the supervisors.
  bool start();

  using Until = RunLimits;

  /// Waits until a component ends the system, all components have failed, the run is interrupted,
  /// or a limit is reached.
  EndReason wait(const Until& until);

  /// The status and the reason that a component gave when it ended the system.
  std::optional<std::pair<int, std::string>> ended() const;

  /// Joins what a file describes to the running system: whole subarchitectures, and components of
  /// those that run. The file is to be read with the names of the running subarchitectures
  /// (`ParseOptions::running_subarchitectures`). Returns the problems; if there are any, the system
  /// is unchanged.
  std::vector<Diagnostic> add(ArchitectureDescription added);

  /// Stops a component, or a subarchitecture with all it consists of, and takes it out of the
  /// system. Returns the error; empty on success.
  std::string remove(const std::string& name);

  /// Waits until all changes so far have been reported to the callbacks of the options, except
  /// those held back for a slow receiver.
  void catch_up();

  /// Stops the components in the reverse order of their start. Working memories stay readable.
  void stop();

  /// Sends a goodbye to the nodes, if the system cannot be destroyed; to be called last.
  void abandon();

  /// Interface by which tests and fault plans inject faults (fault_port.hpp), from any thread.
  FaultPort& faults();

  /// Present participants.
  SystemRosterPtr roster() const;

  SystemSummary summary();

  /// Everything in a subarchitecture's working memory, the most recently written first.
  std::vector<EntryPtr> entries(const std::string& subarchitecture);

  std::vector<std::string> subarchitectures() const;

  /// Time since this system began: simulated time, if it has that.
  Timestamp now() const;

  /// Time origin of this system.
  std::chrono::steady_clock::time_point epoch() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace castor
