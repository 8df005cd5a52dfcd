#pragma once

#include "castor/actors/link/mesh.hpp"
#include "castor/actors/node/clock_reporter.hpp"
#include "castor/actors/node/part.hpp"
#include "castor/actors/node/part_messages.hpp"
#include "castor/actors/node/part_protocol.hpp"

#include <caf/stateful_actor.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>

namespace castor {

struct PartAgentParts {
  ProcessNumber self = 0;
  /// Null where there is only one process.
  std::shared_ptr<Mesh> mesh;
  /// Those of the mesh.
  std::shared_ptr<PartMessages> messages;
  /// Called with the plan before the part is made: connects with the other processes.
  std::function<void(const PartPlan&)> connect;
  PartSpawn spawn = {};
  /// The simulated clock of the coordinator's process. Others make theirs by the plan.
  std::shared_ptr<SimulatedClock> clock = nullptr;
};

struct PartAgentState {
  static constexpr const char* name = "part_agent";

  PartAgentParts parts;
  /// Of a node with a simulated clock.
  std::unique_ptr<ClockReporter> clock_reporter;
  std::unique_ptr<SystemPart> part;
  caf::actor supervisor;
  struct Watched {
    std::string name;
    std::uint64_t incarnation = 1;
    std::shared_ptr<const ComponentRecord> record;
  };
  /// Actors that run here, until their end is processed.
  std::map<caf::actor_addr, Watched> watched;
  /// The other processes that are to be joined, and all with which there is a connection.
  std::set<ProcessNumber> others;
  std::set<ProcessNumber> connected;
  /// Reply due to JoinParts, and the working memories that have not answered yet.
  std::optional<caf::response_promise> joining;
  std::set<caf::actor_addr> unanswered;
  /// Number of JoinParts so far, to recognise late answers.
  std::size_t joins = 0;
};

/// Makes and represents a process's part of a system. Its end is that of the part.
caf::behavior part_agent(caf::stateful_actor<PartAgentState>* self, PartAgentParts parts);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkNews)
