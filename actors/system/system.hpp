#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/task_event.hpp"
#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/runtime/status.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/filters/change_filter.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor {

struct SystemRoster;
using SystemRosterPtr = std::shared_ptr<const SystemRoster>;

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

/// Why `System::wait` returned.
enum class EndReason { ended_by_component, time_over, quiet, interrupted, all_failed };

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

  struct Until {
    /// Nothing: no limit.
    std::optional<std::chrono::nanoseconds> at_most;
    /// Until nothing was changed and nobody was busy for so long.
    std::optional<std::chrono::nanoseconds> quiet;
  };

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

  /// Injects a fault into a component or a working memory; false if there is none of that name in
  /// reach. A working memory crashes, whatever it is. In this process, what is done afterwards
  /// comes after the fault.
  bool inject(const std::string& component, const ComponentFault& x);

  /// Injects a fault into the link between two processes, by their numbers.
  void inject(ProcessNumber a, ProcessNumber b, const LinkFault& x);

  /// Injects a fault into the journal of a working memory, until that has ended; false if there is
  /// no such working memory in reach.
  bool inject(const std::string& subarchitecture, const JournalFault& x);

  /// Lets the clock of a working memory jump; false if there is none in reach.
  bool jump_clock(const std::string& subarchitecture, Timestamp by);

  /// Who takes part now.
  SystemRosterPtr roster() const;

  SystemSummary summary();

  /// Everything in a subarchitecture's working memory, the most recently written first.
  std::vector<EntryPtr> entries(const std::string& subarchitecture);

  std::vector<std::string> subarchitectures() const;

  /// The moment that all times of this system count from.
  std::chrono::steady_clock::time_point epoch() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace castor
