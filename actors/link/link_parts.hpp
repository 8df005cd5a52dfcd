#pragma once

#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/link_record.hpp"
#include "castor/actors/link/mesh.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

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

} // namespace castor
