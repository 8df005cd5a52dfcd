#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>

namespace castor {

/// A place to be reached at: by TCP, or at a Unix socket of this machine.
struct Endpoint {
  /// A name or an address; the absolute path of the socket if it is a Unix socket.
  std::string host;
  /// 0 for a Unix socket.
  std::uint16_t port = 0;

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// Whether a host is the path of a Unix socket.
inline bool is_socket_path(const std::string& host) {
  return host.starts_with('/');
}

/// "robot:7117", "[::1]:7117", "unix:/run/user/1000/castor/links-x1y2z3/0".
std::string to_string(const Endpoint& x);

/// Reads what `to_string` writes; without a port, `default_port`. Throws std::invalid_argument.
Endpoint parse_endpoint(const std::string& text, std::uint16_t default_port);

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
