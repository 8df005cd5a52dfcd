#pragma once

#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/secure_channel.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

/// Layer between a connection and its plain bytes: encryption, or none. Throws SecurityError.
class Channel {
public:
  /// Encrypts if there are credentials.
  Channel(const std::optional<Credentials>& credentials, SecureChannel::Role role) {
    if (credentials)
      secure_.emplace(*credentials, role);
  }

  /// Whether plain bytes may be sent: without encryption always, otherwise after the handshake.
  bool is_ready() const { return !secure_ || secure_->established(); }

  /// Whether the peer's certificate has this name; true without encryption.
  bool proves(std::string_view name) const { return !secure_ || secure_->peer_has_name(name); }

  /// Decrypts bytes from the network. The result is valid until the next call, and no longer than
  /// `from_network`.
  std::span<const std::uint8_t> receive(std::span<const std::uint8_t> from_network) {
    if (!secure_)
      return from_network;
    if (!std::exchange(has_received_, true) && !from_network.empty() &&
        is_begin_of_greeting(static_cast<char>(from_network.front())))
      throw SecurityError(peer_lacks_tls);
    plain_.clear();
    secure_->receive(from_network, plain_);
    return plain_;
  }

  /// Encrypts `plain`, and appends it to `to_network`, with handshake bytes that are due.
  void write(std::vector<char> plain, std::vector<char>& to_network) {
    if (!secure_) {
      if (to_network.empty())
        to_network.swap(plain);
      else
        to_network.insert(to_network.end(), plain.begin(), plain.end());
      return;
    }
    if (!plain.empty())
      secure_->send({reinterpret_cast<const std::uint8_t*>(plain.data()), plain.size()});
    secure_->take_outgoing(to_network);
  }

private:
  std::optional<SecureChannel> secure_;
  bool has_received_ = false;
  Bytes plain_;
};

} // namespace castor
