#pragma once

#include "castor/actors/link/link_parts.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace castor {

/// To a link: the end, once what can be sent was sent.
struct CloseLink {
  std::string reason;
};

/// To a link: from now on the peer is lost after so long without a connection.
struct LinkPatience {
  std::chrono::milliseconds patience{0};
};

/// Connects this process with another one of the same system, for as long as both live: lost
/// connections are made anew and nothing is lost with them. From now on it is the mesh's port to
/// the peer.
caf::actor spawn_link(LinkParts parts);

/// Says how a link gets to its peer: with credentials over TCP; without them to processes of the
/// same user alone, or, if `insecure`, to anybody. At a Unix socket the kernel says who the peer
/// is, and there is nobody to hide anything from.
void secure(LinkParts& parts, const std::optional<Credentials>& credentials, bool insecure);

/// How a link is made.
using LinkSpawn = std::function<caf::actor(LinkParts)>;

/// Waits until actors that were told to end have ended: those of the network are not waited for
/// when an actor system is destroyed, and what they were sent before is lost then.
void await_ends(caf::actor_system& system, const std::vector<caf::actor>& actors);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkPatience)
CASTOR_LOCAL_MESSAGE(castor::CloseLink)
