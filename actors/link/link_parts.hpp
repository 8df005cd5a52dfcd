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
  /// Longest time between two writes, while messages pass.
  std::chrono::milliseconds heartbeat{100};
  /// Time without a message after which the link rests.
  std::chrono::milliseconds rest_after{2000};
  /// Longest time between two writes of a link that rests. Of those of a process to the
  /// coordinator, process 0, which notices the loss of a process by them, it is half of the
  /// silence.
  std::chrono::milliseconds resting_heartbeat{20'000};
  /// The same while one of both sides awaits an answer, and from the coordinator.
  std::chrono::milliseconds awaiting_heartbeat{5000};
  /// Time without input that should have come after which the connection is closed and made anew.
  std::chrono::milliseconds silence{1000};
  /// Time without a connection after which the peer is lost.
  std::chrono::milliseconds patience{30'000};
  /// Longest time for connecting and exchanging greetings.
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
  /// Hello to send to the peer.
  Hello self;
  /// With them, connections are encrypted and names are proved.
  std::optional<Credentials> credentials;
  /// Peers that `dial` may connect to.
  PeerTrust trust = PeerTrust::same_user;
  LinkOptions options;
  /// Called on the network's thread.
  std::function<void(const LinkNews&)> on_news;
};

} // namespace castor
