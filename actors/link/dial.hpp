#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>

namespace castor {

/// A place to be reached at.
struct Endpoint {
  std::string host;
  std::uint16_t port = 0;

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// "robot:7117", "[::1]:7117".
std::string to_string(const Endpoint& x);

/// Reads what `to_string` writes; without a port, `default_port`. Throws std::invalid_argument.
Endpoint parse_endpoint(const std::string& text, std::uint16_t default_port);

/// Connects by TCP, without ever hanging: tries every address that the host has until one answers.
/// Returns a socket, or why there is none. Gives up early once `cancelled` says so.
std::variant<int, std::string> dial(const Endpoint& to, std::chrono::milliseconds patience,
                                    const std::function<bool()>& cancelled);

/// A socket that listens for TCP; port 0 for any. Throws std::runtime_error, which says why.
int listen_at(const Endpoint& at);

/// The port that a listening socket has.
std::uint16_t port_of(int socket);

/// Why nobody knows where that host is; empty if it has an address.
std::string why_unknown(const std::string& host);

/// Whether everybody who can connect is on this machine.
bool is_loopback(const std::string& host);

} // namespace castor
