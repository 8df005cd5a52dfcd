#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/diagnostic.hpp"
#include "castor/actors/component/status.hpp"
#include "castor/actors/link/link.hpp"
#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/supervision/health.hpp"
#include "castor/actors/task_manager/task_event.hpp"
#include "castor/wm/change_event.hpp"
#include "castor/wm/change_filter.hpp"
#include "castor/wm/entry.hpp"

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

/// A system that cannot be run as described: `what()` says why, with places in the file.
class SystemError : public std::runtime_error {
public:
  explicit SystemError(std::vector<cast::Diagnostic> diagnostics);

  const std::vector<cast::Diagnostic>& diagnostics() const { return diagnostics_; }

private:
  std::vector<cast::Diagnostic> diagnostics_;
};

struct SystemRoster;
using SystemRosterPtr = std::shared_ptr<const SystemRoster>;

struct SystemOptions {
  /// Every subarchitecture may write to every other, as in the original CAST.
  bool open_access = false;

  /// Every change is told to every working memory, wanted or not: the original's early scheme, for
  /// comparison.
  bool broadcast = false;

  /// Components that fail are started again, as the architecture says. Otherwise each stays down,
  /// and the others go on without it.
  bool restarts = true;

  /// Where nodes listen, by the hosts that the architecture names; hosts that are not here are
  /// looked for where their names say.
  std::map<std::string, Endpoint> nodes;

  /// With them, what is said to nodes is encrypted and names are proved.
  std::optional<Credentials> credentials;

  /// Talk to nodes on other machines without credentials.
  bool insecure = false;

  /// The socket at which people and programs of the same user find the running system
  /// (local_endpoint.hpp); empty for none.
  std::filesystem::path endpoint;

  /// How long nodes may take to be reached, before the system is given up.
  std::chrono::milliseconds connect_patience{5'000};

  /// How long processes may take to make their parts of the system, for which they may have to load
  /// libraries.
  std::chrono::milliseconds part_patience{15'000};

  /// How long processes may take to answer a question.
  std::chrono::milliseconds answer_patience{2000};

  /// Every process writes down in this folder of its machine what its components ask of working
  /// memories, and what they are answered (operation_log.hpp), and so does the endpoint for
  /// operators; empty for none.
  std::filesystem::path operations;

  /// Every process records in this folder of its machine what its stand-alone components hand out
  /// (push_log.hpp); empty for none. Of what takes more than the limit in all, the oldest is
  /// dropped.
  std::filesystem::path pushes;
  std::uint64_t pushes_limit = std::uint64_t{1} << 30;

  /// How a node that went out of reach is treated.
  LinkOptions link;

  /// How long a component may take to stop before it is given up.
  std::chrono::milliseconds stop_patience{5000};

  /// Called with every change in every working memory, one at a time, those of one working memory
  /// in their order; not on any component's thread.
  std::function<void(const ChangeEvent&)> on_change;

  /// Called like `on_change`, and with the entry as it was read after the change: it may be newer,
  /// and is null if it was gone by then.
  std::function<void(const ChangeEvent&, const EntryPtr&)> on_entry;

  /// Called like `on_change`, with the changes that one of these filters wants, and with its place
  /// among them. Filters without a subarchitecture are for all of them.
  std::vector<ChangeFilter> watched;
  std::function<void(std::size_t filter, const ChangeEvent&)> on_watched;

  /// Called with what becomes of every proposed task, those of one task manager in their order;
  /// never at the same time as `on_change`.
  std::function<void(const TaskEvent&)> on_task;

  /// Called when a component or a working memory has gone down, and when it is back. By one thread
  /// at a time, which has better things to do than to wait.
  std::function<void(const ComponentDown&)> on_down;
  std::function<void(const ComponentUp&)> on_up;

  /// Called when an injected fault with a number (`FaultTicket`) takes effect; on a thread of its
  /// own, with news of one fault at a time.
  std::function<void(std::uint64_t fault)> on_fault_happened;

  /// Kills the process of a host that is a child of this process, as those of isolated components
  /// and local nodes are, if it was started before this moment: not one that has taken its place
  /// since. False if there is none. Whoever gives this starts it again. Called from any thread.
  std::function<bool(const std::string& host, std::chrono::steady_clock::time_point started_before)>
    kill_child;

  /// Asked now and then during lengthy work; true makes the system give up waiting.
  std::function<bool()> interrupted;
};

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
  std::vector<cast::Diagnostic> add(ArchitectureDescription added);

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

  /// Lets something befall a component or a working memory; false if there is none of that name in
  /// reach. A working memory crashes, whatever it is. In this process, what is done afterwards
  /// comes after the fault.
  bool befall(const std::string& component, const ComponentFault& x);

  /// Lets something befall the link between two processes, by their numbers.
  void befall(ProcessNumber a, ProcessNumber b, const LinkFault& x);

  /// Lets something befall the journal of a working memory, until that has ended; false if there is
  /// no such working memory in reach.
  bool befall(const std::string& subarchitecture, const JournalFault& x);

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
