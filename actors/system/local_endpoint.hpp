#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/supervision/roster.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

/// How people and programs on this machine find out about a running system, and change it: a socket
/// that only their user can reach. It speaks JSON, one object on a line; docs/introspection.md has
/// the requests.
namespace castor {

class OperationLog;

/// Where a system that this process runs can be found. Throws std::runtime_error if there is no
/// place that others cannot reach.
std::filesystem::path endpoint_of_process(const std::string& system_file);

/// Why the system could not be changed; all is empty if it was.
struct OrderOutcome {
  std::string problem;
  /// Of what was to be added.
  std::vector<Diagnostic> findings;
};

/// Somebody wants the system to be changed.
struct SystemOrder {
  /// What to add, or the name of what to remove.
  std::variant<ArchitectureDescription, std::string> what;
  /// To be called with what stood in the way.
  std::function<void(const OrderOutcome&)> done;
};

/// Listens at the socket, which goes with the actor. It has to be sent a SystemRosterPtr, and again
/// whenever that has changed. `give_order` is called from any thread. What operators ask of working
/// memories is written down in `operations`, unless it is null. Throws std::runtime_error.
caf::actor open_local_endpoint(caf::actor_system& system, const std::filesystem::path& socket,
                               std::function<void(SystemOrder)> give_order,
                               std::shared_ptr<OperationLog> operations = nullptr);

} // namespace castor
