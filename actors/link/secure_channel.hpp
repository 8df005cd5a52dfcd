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

/// The peer has no room for another connection; the next attempt may find some.
class BusyPeerError : public SecurityError {
  using SecurityError::SecurityError;
};

/// What tells a peer that expects TLS that there is no room for its connection: an alert in the
/// clear ("user canceled", RFC 8446, section 6.1), for which no handshake is needed.
std::vector<char> busy_alert();

/// One end of an encrypted connection: mutual TLS 1.3 without a socket. It is told what arrived
/// from the network and gives what to write there, in pieces of any size. For one thread at a time.
///
/// Whatever is wrong with the peer or the connection is a SecurityError, thrown by `receive`, and
/// after that by every further call of `receive` and `send`. `take_outgoing` still works then: it
/// gives what tells the peer why, to be written before the connection is closed. That a peer never
/// finishes its handshake is for the owner of the connection to notice.
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

  /// Takes all of what arrived and appends what it means to `plain`. The same call may establish
  /// the channel and bring the first bytes: look at the peer's name before using them. What was
  /// appended before an error is genuine.
  void receive(std::span<const std::uint8_t> from_network, Bytes& plain);

  /// Encrypts for the peer. A std::logic_error before the channel is established: nobody should
  /// speak before knowing to whom.
  void send(std::span<const std::uint8_t> plain);

  /// Appends what is to be written to the network; to be called after the constructor, `receive`
  /// and `send`.
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
