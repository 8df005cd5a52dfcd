#pragma once

#include "castor/actors/supervision/roster.hpp"
#include "castor/actors/system/system_order.hpp"

#include <caf/actor.hpp>
#include <caf/fwd.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

/// Socket at which people and programs on this machine inspect and change a running system; only
/// processes of its user can reach it. The protocol is JSON, one object on a line;
/// docs/introspection.md has the requests.
namespace castor {

class ClockControl;
class OperationLog;

/// Path of the socket of a system that this process runs. Throws std::runtime_error if there is no
/// private folder for it.
std::filesystem::path endpoint_of_process(const std::string& system_file);

/// Listens at the socket, which goes with the actor. It has to be sent a SystemRosterPtr, and again
/// whenever that has changed. `give_order` is called from any thread. Operations of operators on
/// working memories are logged in `operations`, unless it is null. `clock` is null for the real
/// one. Throws std::runtime_error.
caf::actor open_local_endpoint(caf::actor_system& system, const std::filesystem::path& socket,
                               std::function<void(SystemOrder)> give_order,
                               std::shared_ptr<OperationLog> operations = nullptr,
                               std::shared_ptr<ClockControl> clock = nullptr);

} // namespace castor
