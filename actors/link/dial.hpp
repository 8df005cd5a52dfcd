#pragma once

#include "castor/actors/link/endpoint.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>

namespace castor {

/// Whom a TCP connection may lead to.
enum class PeerTrust {
  /// To nobody. Addresses of this machine stand for the Unix sockets beside them (node_socket.hpp),
  /// at which a process of the same user listens.
  same_user,
  /// To whatever listens there; it will have to prove its name.
  certified,
  /// To whatever listens there, unless there is a node of the same user.
  anybody,
};

/// Connects, without ever hanging: tries every address that the host has until one answers. Returns
/// a socket, or why there is none. Gives up early once `cancelled` says so. At a Unix socket, only
/// a process of the same user is believed, whatever `trust` says.
std::variant<int, std::string> dial(const Endpoint& to, PeerTrust trust,
                                    std::chrono::milliseconds patience,
                                    const std::function<bool()>& cancelled);

/// A socket that listens, for TCP with port 0 for any, or at a path. Throws std::runtime_error,
/// which says why.
int listen_at(const Endpoint& at);

/// The port that a listening TCP socket has.
std::uint16_t port_of(int socket);

/// Why nobody knows where that host is; empty if it has an address, or is a path.
std::string why_unknown(const std::string& host);

/// Whether everybody who can connect is on this machine.
bool is_loopback(const std::string& host);

} // namespace castor
