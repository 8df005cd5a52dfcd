#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/system/run_limits.hpp"
#include "castor/actors/system/system_summary.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/entries/entry.hpp"

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

/// A whole architecture: its coordinator, and what of it runs in this process. The rest runs on
/// nodes, where the architecture says so.
///
///     System system{architecture};
///     system.start();
///     system.wait({.at_most = 10s});
///     system.stop();
///
/// Made, used and destroyed on one thread.
class System {
public:
  /// Throws SystemError if the architecture names classes, options or hosts that are not to be had,
  /// or nodes that are not to be reached; then nothing of it is left anywhere.
  explicit System(ArchitectureDescription architecture, SystemOptions options = {});
  System(const System&) = delete;
  System& operator=(const System&) = delete;
  /// Stops what was not stopped.
  ~System();

  /// Configures every component, then starts every component, then lets them run. False if it was
  /// interrupted. Throws SystemError if a configure() fails, because the configuration is wrong
  /// then; nothing was started. All other failures are dealt with by the supervisors.
  bool start();

  using Until = RunLimits;

  /// Waits until the system ends of itself, or for the other reasons asked for.
  EndReason wait(const Until& until);

  /// The status and the reason that a component gave when it ended the system.
  std::optional<std::pair<int, std::string>> ended() const;

  /// Joins what a file describes to the running system: whole subarchitectures, and components of
  /// those that run. The file is to be read with the names of the running subarchitectures
  /// (`ParseOptions::running_subarchitectures`). Returns what stands in the way; then the system is
  /// as it was.
  std::vector<Diagnostic> add(ArchitectureDescription added);

  /// Stops a component, or a subarchitecture with all it consists of, and takes it out of the
  /// system. Returns why that cannot be done; empty if it was.
  std::string remove(const std::string& name);

  /// Waits until everything that has changed by now has been told, as far as nobody is too slow for
  /// it.
  void catch_up();

  /// Stops the components in the reverse order of their start. Working memories stay readable.
  void stop();

  /// Takes leave of the nodes, where the system cannot be destroyed; to be called last.
  void abandon();

  /// Through which tests and fault plans inject faults (fault_port.hpp), from any thread.
  FaultPort& faults();

  /// Who takes part now.
  SystemRosterPtr roster() const;

  SystemSummary summary();

  /// Everything in a subarchitecture's working memory, the most recently written first.
  std::vector<EntryPtr> entries(const std::string& subarchitecture);

  std::vector<std::string> subarchitectures() const;

  /// The moment that all times of this system count from.
  std::chrono::steady_clock::time_point epoch() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace castor
