#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/task_event.hpp"
#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/link/link_record.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/runtime/status.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/clock/clock_messages.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

/// Messages between a system's coordinator and the agents of its parts, one in every process.
namespace castor {

/// A process that takes part in a system.
struct ProcessDescription {
  std::string name;
  /// Where the others reach it.
  std::string host;
  std::uint16_t port = 0;
  /// Whether the process is lost, so that nobody needs to reach it.
  bool lost = false;
};

/// Placement of a component that is not to be made yet.
inline constexpr ProcessNumber nowhere = 0xffff;

/// Process of a component. `placement` leaves out the components of the coordinator's process.
inline ProcessNumber process_of(const std::map<std::string, ProcessNumber>& placement,
                                const std::string& component) {
  auto i = placement.find(component);
  return i == placement.end() ? ProcessNumber{0} : i->second;
}

/// Plan of a system, from which each process makes its part.
struct PartPlan {
  /// The name of the system, which differs from those of all others.
  std::string system;
  ArchitectureDescription architecture;
  /// By their numbers; the first is the coordinator's own, which nobody needs to reach.
  std::vector<ProcessDescription> processes;
  /// Where components, working memories and task managers live, by name.
  std::map<std::string, ProcessNumber> placement;
  /// Incarnation that each of them is to have, by name; 1 if it is not listed. One of another
  /// incarnation is ended and made anew.
  std::map<std::string, std::uint64_t> incarnations;
  /// The components that are not started again if they fail.
  std::set<std::string> temporary;
  /// Every subarchitecture may write to every other.
  bool open_access = false;
  /// Every change event is sent to every working memory.
  bool broadcast = false;
  /// Folder of the operation logs, on each machine; empty for none.
  std::string operations;
  /// Folder in which values handed out by stand-alone components are recorded, on each machine, and
  /// its limit in bytes; empty for none.
  std::string pushes;
  std::uint64_t pushes_limit = 0;
  /// How long the system has existed, when this was sent.
  Timestamp age{0};
  /// Whether the clock is simulated, and what it shows.
  bool simulated_clock = false;
  ClockAdvance clock;
  /// Time without a connection after which a process is lost.
  std::chrono::milliseconds patience{0};
  /// Receiver of EndSystem.
  caf::actor coordinator;
  /// Receiver of ComponentEnded.
  caf::actor supervisor;
  /// Receiver of every TaskEvent, or null.
  caf::actor task_observer;
};

/// The actors of a part, by the names of the components.
struct PartMade {
  /// Why the part cannot be made; if there are any, there are no actors.
  std::vector<Diagnostic> problems;
  std::map<std::string, caf::strong_actor_ptr> actors;
};

/// The actors of all parts: introduces them to each other. Answered with Acknowledged once the part
/// is connected with the others and its working memories know theirs.
struct JoinParts {
  std::map<std::string, caf::strong_actor_ptr> actors;
  /// Processes that have made their parts; the others are not waited for.
  std::set<ProcessNumber> processes;
};

/// Ends a component, if it has not ended yet, and makes it anew; answered with PartMade.
struct RestartComponent {
  std::string name;
  std::uint64_t incarnation = 0;
};

/// To the supervisor: a component or a working memory has ended.
struct ComponentEnded {
  enum class How : std::uint8_t {
    /// It was told to, or had done its work.
    stopped,
    failed,
    /// Its working memory has ended, which it needs.
    orphaned,
  };

  std::string name;
  std::uint64_t incarnation = 0;
  How how = How::stopped;
  /// Why it failed.
  std::string failure;
  /// Component or working memory that was down, so that it failed; empty for other reasons.
  std::string waited_for = {};
};

/// To the supervisor: a component has not returned from its own code within its budget.
struct ComponentHangs {
  std::string name;
  std::uint64_t incarnation = 0;
};

/// A fault to inject into a component; a working memory crashes, whatever the fault is.
struct InjectComponentFault {
  std::string name;
  ComponentFault fault;
};

/// A fault to inject into the link to another process.
struct InjectLinkFault {
  ProcessNumber peer = 0;
  LinkFault fault;
};

struct PartStatusQuery {};

/// Resource usage of a process.
struct ProcessUsage {
  /// Of all its threads, since it was started.
  std::chrono::nanoseconds cpu{0};
  std::chrono::nanoseconds age{0};
  /// Resident.
  std::uint64_t memory_bytes = 0;
};

struct PartStatus {
  std::vector<ComponentStatus> components;
  /// Links to the other processes.
  std::vector<LinkStatus> links;
  ProcessUsage usage;
};

/// Request of a component to end the whole system.
struct EndSystem {
  int status = 0;
  std::string reason;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::PartPlan)
CASTOR_LOCAL_MESSAGE(castor::PartMade)
CASTOR_LOCAL_MESSAGE(castor::JoinParts)
CASTOR_LOCAL_MESSAGE(castor::RestartComponent)
CASTOR_LOCAL_MESSAGE(castor::ComponentEnded)
CASTOR_LOCAL_MESSAGE(castor::ComponentHangs)
CASTOR_LOCAL_MESSAGE(castor::InjectComponentFault)
CASTOR_LOCAL_MESSAGE(castor::InjectLinkFault)
CASTOR_LOCAL_MESSAGE(castor::PartStatusQuery)
CASTOR_LOCAL_MESSAGE(castor::PartStatus)
CASTOR_LOCAL_MESSAGE(castor::EndSystem)
CASTOR_LOCAL_MESSAGE(castor::TaskEvent)
