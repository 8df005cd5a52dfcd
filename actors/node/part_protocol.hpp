#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/task_event.hpp"
#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/link/link_record.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/runtime/status.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

/// What a system's coordinator says to the agents of its parts, one in every process, and they to
/// it.
namespace castor {

/// A process that takes part in a system.
struct ProcessDescription {
  std::string name;
  /// Where the others reach it.
  std::string host;
  std::uint16_t port = 0;
  /// Nobody needs to reach it any more.
  bool lost = false;
};

/// Where a component runs that is not to be made yet.
inline constexpr ProcessNumber nowhere = 0xffff;

/// Where a component runs, as `placement` has it, which leaves out what the coordinator runs.
inline ProcessNumber process_of(const std::map<std::string, ProcessNumber>& placement,
                                const std::string& component) {
  auto i = placement.find(component);
  return i == placement.end() ? ProcessNumber{0} : i->second;
}

/// What a process needs to know in order to make its part of a system.
struct PartPlan {
  /// The name of the system, which differs from those of all others.
  std::string system;
  ArchitectureDescription architecture;
  /// By their numbers; the first is the coordinator's own, which nobody needs to reach.
  std::vector<ProcessDescription> processes;
  /// Where components, working memories and task managers live, by name.
  std::map<std::string, ProcessNumber> placement;
  /// Which of its lives each of them is to live, by name; the first where nothing is said. One that
  /// lives another one is ended and made anew.
  std::map<std::string, std::uint64_t> incarnations;
  /// The components that are not started again if they fail.
  std::set<std::string> temporary;
  /// Every subarchitecture may write to every other.
  bool open_access = false;
  /// Every change is told to every working memory.
  bool broadcast = false;
  /// The folder in which operations are written down, on each machine; empty for none.
  std::string operations;
  /// The folder in which is recorded what stand-alone components hand out, on each machine, and how
  /// many bytes that may take in all; empty for none.
  std::string pushes;
  std::uint64_t pushes_limit = 0;
  /// How long the system has existed, when this was sent.
  Timestamp age{0};
  /// After so long without a connection, a process is lost.
  std::chrono::milliseconds patience{0};
  /// Is sent EndSystem by whoever wants that.
  caf::actor coordinator;
  /// Is sent ComponentEnded.
  caf::actor supervisor;
  /// Is sent every TaskEvent; null if nobody wants to know.
  caf::actor task_observer;
};

/// The actors of a part, by the names of the components.
struct PartMade {
  /// Why it cannot be made, then there are no actors.
  std::vector<Diagnostic> problems;
  std::map<std::string, caf::strong_actor_ptr> actors;
};

/// The actors of all parts: introduces them to each other. Answered with Acknowledged once the part
/// is connected with the others and its working memories know theirs.
struct JoinParts {
  std::map<std::string, caf::strong_actor_ptr> actors;
  /// Those that have made their parts; the rest is not waited for.
  std::set<ProcessNumber> processes;
};

/// Ends a component, if it has not ended yet, and makes it anew; answered with PartMade.
struct RestartComponent {
  std::string name;
  std::uint64_t incarnation = 0;
};

/// To the supervisor: a component or a working memory is not there any more.
struct ComponentEnded {
  enum class How : std::uint8_t {
    /// It was told to, or had done its work.
    stopped,
    failed,
    /// Its working memory has ended, and it could not go on without.
    orphaned,
  };

  std::string name;
  std::uint64_t incarnation = 0;
  How how = How::stopped;
  /// Why it failed.
  std::string failure;
  /// Who was down, so that it could not go on; empty if that is not why it failed.
  std::string waited_for = {};
};

/// To the supervisor: a component has not come back from its own code within its budget.
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

/// What a process has taken of its machine.
struct ProcessUsage {
  /// Of all its threads, since it was started.
  std::chrono::nanoseconds cpu{0};
  std::chrono::nanoseconds age{0};
  /// Resident.
  std::uint64_t memory_bytes = 0;
};

struct PartStatus {
  std::vector<ComponentStatus> components;
  /// To the other processes.
  std::vector<LinkStatus> links;
  ProcessUsage usage;
};

/// A component wants the whole system to end.
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
