#pragma once

#include "castor/actors/link/credentials.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// The peer has no room for another connection; a later attempt may succeed.
class BusyPeerError : public SecurityError {
  using SecurityError::SecurityError;
};

/// Refusal for a peer that expects TLS, for lack of room: an alert in the clear ("user canceled",
/// RFC 8446, section 6.1), for which no handshake is needed.
std::vector<char> busy_alert();

/// One end of an encrypted connection: mutual TLS 1.3 without a socket. Takes bytes that arrived
/// from the network, in pieces of any size, and returns those to write there. For one thread at a
/// time.
///
/// Whatever is wrong with the peer or the connection is a SecurityError, thrown by `receive`, and
/// after that by every further call of `receive` and `send`. `take_outgoing` still works then: it
/// returns the alert for the peer, to be written before the connection is closed. Handshakes that
/// never finish have to be timed out by the owner of the connection.
class SecureChannel {
public:
  enum class Role : std::uint8_t { dials, accepts };

  /// A `send` changes the key once that has encrypted `records_per_key` records, of up to 16 KiB
  /// each; a `send` is at least one. AES-GCM allows for 2^24.5 (RFC 8446, section 5.5).
  SecureChannel(const Credentials& credentials, Role role,
                std::uint64_t records_per_key = std::uint64_t{1} << 22);
  SecureChannel(SecureChannel&&) noexcept;
  SecureChannel& operator=(SecureChannel&&) noexcept;
  ~SecureChannel();

  /// Decrypts all of `from_network`, and appends the result to `plain`. The same call may establish
  /// the channel and bring the first bytes: look at the peer's name before using them. What was
  /// appended before an error is genuine.
  void receive(std::span<const std::uint8_t> from_network, Bytes& plain);

  /// Encrypts for the peer. Throws std::logic_error before the channel is established, while the
  /// peer is unknown.
  void send(std::span<const std::uint8_t> plain);

  /// Appends the bytes to write to the network; to be called after the constructor, `receive` and
  /// `send`.
  void take_outgoing(std::vector<char>& out);

  /// Whether the peer's certificate is signed by our CA and the peer has shown that it holds the
  /// key. It may still refuse ours, which the dialling side learns from a later `receive` only.
  bool established() const;

  /// The names that the peer's certificate proves; none before the channel is established.
  const std::vector<std::string>& peer_names() const;

  /// Compares letter by letter; no patterns, no aliases.
  bool peer_has_name(std::string_view name) const;

private:
  struct State;

  std::unique_ptr<State> state_;
};

} // namespace castor
