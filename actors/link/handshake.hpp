#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace castor {

/// First message of each side of a new connection.
struct Hello {
  /// The sender's name, which its certificate must bear where there are certificates.
  std::string node;
  /// The system that the connection is for.
  std::string system;
  /// Incarnation of the sender's part of the system; unique over all processes.
  std::uint64_t incarnation = 0;
  /// The sender's number in the system, and the receiver's.
  std::uint16_t process = 0;
  std::uint16_t receiver = 0;
  /// The receiver's incarnation as the sender knows it; 0 if this is the first connection.
  std::uint64_t known = 0;
  /// Number of parts that the sender has received in the session so far.
  std::uint64_t received = 0;
  /// Number of the connection, counted by the side that dials: connections that arrive after a
  /// later one are closed.
  std::uint64_t attempt = 0;
};

/// Refuses the connection, instead of a hello.
struct Refusal {
  std::string reason;
  /// Whether trying again is useless.
  bool final = true;
};

using Greeting = std::variant<Hello, Refusal>;

/// Appends a greeting in its wire form.
void write_greeting(std::vector<char>& out, const Greeting& x);

/// Errors if only one of two sides uses TLS; "it" is the peer of the side that reports the error.
inline constexpr const char* peer_uses_tls =
  "it uses TLS, but this process was started without --tls DIR";
inline constexpr const char* peer_lacks_tls =
  "it does not use TLS, but this process was started with --tls: both sides need --tls DIR, or "
  "neither";

/// Whether a greeting may begin with this byte. A TLS connection never does.
bool is_begin_of_greeting(char first);

/// Takes a greeting from the beginning of `bytes`, and removes it there; nothing while it is
/// incomplete. Throws LinkError (session.hpp) at once if it cannot be one of ours.
std::optional<Greeting> read_greeting(Bytes& bytes);

} // namespace castor
