#pragma once

#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/link_record.hpp"
#include "castor/actors/link/mesh.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor {

struct LinkOptions {
  /// How often something is said, at least.
  std::chrono::milliseconds heartbeat{100};
  /// After so long without a word from the peer, the connection is given up and made anew.
  std::chrono::milliseconds silence{1000};
  /// After so long without a connection, the peer is lost.
  std::chrono::milliseconds patience{30'000};
  /// How long a connection may take to be made, and the greetings to be said.
  std::chrono::milliseconds connecting{3000};
  SessionLimits session;
};

struct LinkParts {
  std::shared_ptr<Mesh> mesh;
  ProcessNumber peer = 0;
  /// The name that the peer must have; empty for any.
  std::string peer_name;
  /// Where the peer listens; nothing if it is the peer that dials.
  std::optional<Endpoint> dial;
  /// What to say to the peer.
  Hello self;
  /// With them, connections are encrypted and names are proved.
  std::optional<Credentials> credentials;
  /// Whom `dial` may lead to.
  PeerTrust trust = PeerTrust::same_user;
  LinkOptions options;
  /// Called on the network's thread.
  std::function<void(const LinkNews&)> on_news;
};

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
