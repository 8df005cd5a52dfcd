#pragma once

#include <cstdint>
#include <string>

namespace castor {

/// A TCP address, or a Unix socket of this machine.
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

} // namespace castor
