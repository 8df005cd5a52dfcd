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

/// The actor that makes a system what it is to be, in all its processes, and keeps it so: it alone
/// starts, stops and restarts what a system consists of.
namespace castor {

/// From now on the system is to consist of this; answered with Deployed. Nothing is started yet,
/// but what is not wanted any more is ended.
struct Deploy {
  ArchitectureDescription architecture;
  Placement placement;
};

struct Deployed {
  /// What stands in the way; then the system may be half of what it was to be.
  std::vector<Diagnostic> problems;
};

/// Configures all of these, then starts them all, then lets them run; answered with
/// ComponentsStarted.
struct StartComponents {
  std::vector<std::string> names;
};

struct ComponentsStarted {
  /// What is wrong with the configuration of those whose configure() has failed. Then none of them
  /// was started, and none will be.
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
  /// They did not come back from their own code.
  std::vector<std::string> stuck;
};

struct SupervisorParts {
  /// Has to outlive the supervisor.
  Processes* processes = nullptr;
  const SystemOptions* options = nullptr;
  std::string file;
  std::chrono::steady_clock::time_point epoch;
  /// That of the jitter of delays; nothing for one that nobody knows.
  std::optional<std::uint64_t> seed = {};
  /// Is sent EndSystem.
  caf::actor end_listener;
  /// Is sent every TaskEvent; null if nobody wants to know.
  caf::actor task_observer;
  /// Called whenever the system has become another.
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
