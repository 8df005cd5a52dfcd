#pragma once

#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/mesh.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace castor {

/// What a link has carried; safe to read from any thread.
struct LinkCounters {
  std::atomic<std::uint64_t> messages_out{0};
  std::atomic<std::uint64_t> messages_in{0};
  std::atomic<std::uint64_t> bytes_out{0};
  std::atomic<std::uint64_t> bytes_in{0};
  std::atomic<std::uint64_t> connections{0};
  /// Bytes of messages that the peer has not acknowledged.
  std::atomic<std::uint64_t> unacknowledged{0};
};

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

/// What becomes of a link.
struct LinkNews {
  enum class Kind : std::uint8_t {
    /// There is a connection, for the first time or again.
    up,
    /// The connection was lost; what is sent meanwhile waits.
    down,
    /// There will be no connection any more.
    lost,
  };

  ProcessNumber peer = 0;
  Kind kind = Kind::up;
  /// Why.
  std::string reason;
  /// The peer's name, once it has introduced itself.
  std::string name;
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
  LinkOptions options;
  std::shared_ptr<LinkCounters> counters;
  /// Called on the network's thread.
  std::function<void(const LinkNews&)> on_news;
};

/// To a link: the end, once what can be sent was sent.
struct CloseLink {
  std::string reason;
};

/// Connects this process with another one of the same system, for as long as both live: lost
/// connections are made anew and nothing is lost with them.
caf::actor spawn_link(caf::actor_system& system, LinkParts parts);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::CloseLink)
