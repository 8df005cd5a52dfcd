#pragma once

#include "castor/actors/link/endpoint.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>

namespace castor {

/// Peers that `dial` may connect to over TCP.
enum class PeerTrust {
  /// None. An address of this machine is replaced by the Unix socket beside it (node_socket.hpp),
  /// at which a process of the same user listens.
  same_user,
  /// Any listener; it has to prove its name with a certificate.
  certified,
  /// Any listener, but on this machine a node of the same user takes precedence.
  anybody,
};

/// Connects within `patience`: tries every address of the host until one answers. Returns a socket,
/// or why there is none. Gives up early once `cancelled` returns true. At a Unix socket, only a
/// process of the same user is accepted, regardless of `trust`.
std::variant<int, std::string> dial(const Endpoint& to, PeerTrust trust,
                                    std::chrono::milliseconds patience,
                                    const std::function<bool()>& cancelled);

/// A socket that listens, for TCP with port 0 for any, or at a path. Throws std::runtime_error,
/// which says why.
int listen_at(const Endpoint& at);

/// The port that a listening TCP socket has.
std::uint16_t port_of(int socket);

/// Why the host cannot be resolved; empty if it has an address, or is a path.
std::string why_unknown(const std::string& host);

/// Whether everybody who can connect is on this machine.
bool is_loopback(const std::string& host);

} // namespace castor
