#pragma once

#include "castor/actors/link/link_parts.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace castor {

/// To a link: end, after sending what can be sent.
struct CloseLink {
  std::string reason;
};

/// To a link: time without a connection after which the peer is lost, from now on.
struct LinkPatience {
  std::chrono::milliseconds patience{0};
};

/// Connects this process with another one of the same system, for as long as both live: lost
/// connections are made anew, without loss of messages. Registers the link with the mesh.
caf::actor spawn_link(LinkParts parts);

/// Sets which peers a link connects to: with credentials over TCP; without them only processes of
/// the same user, or, if `insecure`, any. At a Unix socket the kernel identifies the peer, and
/// encryption is not needed.
void secure(LinkParts& parts, const std::optional<Credentials>& credentials, bool insecure);

/// Creates a link.
using LinkSpawn = std::function<caf::actor(LinkParts)>;

/// Waits until actors that were told to end have ended: the destructor of an actor system does not
/// wait for network actors, and messages sent to them before would be lost.
void await_ends(caf::actor_system& system, const std::vector<caf::actor>& actors);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkPatience)
CASTOR_LOCAL_MESSAGE(castor::CloseLink)
