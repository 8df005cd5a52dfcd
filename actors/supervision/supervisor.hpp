#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/supervision/roster.hpp"
#include "castor/base/diagnostic.hpp"

#include <caf/event_based_actor.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// The actor that deploys a system in all its processes, and keeps it running: only this actor
/// starts, stops and restarts components and working memories.
namespace castor {

/// New architecture and placement of the system; answered with Deployed. Nothing is started yet,
/// but what is not part of it any more is ended.
struct Deploy {
  ArchitectureDescription architecture;
  Placement placement;
};

struct Deployed {
  /// Problems; if there are any, the system may be deployed in part only.
  std::vector<Diagnostic> problems;
};

/// Configures all of these, then starts them all, then lets them run; answered with
/// ComponentsStarted.
struct StartComponents {
  std::vector<std::string> names;
};

struct ComponentsStarted {
  /// Configuration errors of those whose configure() has failed. If there are any, none of them was
  /// started, and none will be.
  std::vector<Diagnostic> problems;
};

/// Stops these in the reverse order of their start; answered with ComponentsStopped. They are not
/// started again.
struct StopComponents {
  std::vector<std::string> names;
};

struct ComponentsStopped {
  /// In the order of their end.
  std::vector<std::string> stopped;
  /// Those that did not return from their own code.
  std::vector<std::string> stuck;
};

struct SupervisorParts {
  /// Has to outlive the supervisor.
  Processes* processes = nullptr;
  const SystemOptions* options = nullptr;
  std::string file;
  std::chrono::steady_clock::time_point epoch;
  /// Null for the real clock.
  std::shared_ptr<SimulatedClock> clock = nullptr;
  /// Seed of the jitter of delays; random if there is no value.
  std::optional<std::uint64_t> seed = {};
  /// Receiver of EndSystem.
  caf::actor end_listener;
  /// Receiver of every TaskEvent, or null.
  caf::actor task_observer;
  /// Called whenever the system has changed.
  std::function<void(SystemRosterPtr)> on_change;
};

caf::behavior supervisor(caf::event_based_actor* self, SupervisorParts parts);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::Deploy)
CASTOR_LOCAL_MESSAGE(castor::Deployed)
CASTOR_LOCAL_MESSAGE(castor::StartComponents)
CASTOR_LOCAL_MESSAGE(castor::ComponentsStarted)
CASTOR_LOCAL_MESSAGE(castor::StopComponents)
CASTOR_LOCAL_MESSAGE(castor::ComponentsStopped)
