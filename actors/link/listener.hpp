#pragma once

#include "castor/actors/link/admission.hpp"
#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/base/caf.hpp"

#include <functional>
#include <optional>
#include <variant>

namespace castor {

struct ListenerParts {
  /// Listens already (`listen_at`); belongs to the listener from now on.
  int socket = -1;
  /// Which link a connection is for. Called on the network's thread.
  std::function<std::variant<caf::actor, Refusal>(const Hello&)> route;
  /// With them, connections have to be encrypted and names proved.
  std::optional<Credentials> credentials = {};
  /// Limits on connections that have not introduced themselves.
  AdmissionLimits admission = {};
};

/// Accepts connections, reads their hello, and passes them to the links they are for. Connections
/// without a valid hello are closed, without an effect on others.
caf::actor spawn_listener(caf::actor_system& system, ListenerParts parts);

} // namespace castor
