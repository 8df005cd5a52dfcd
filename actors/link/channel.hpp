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

/// What lies between a connection and what is said over it: nothing, or encryption. Throws
/// SecurityError.
class Channel {
public:
  /// With credentials, an encrypted one.
  Channel(const std::optional<Credentials>& credentials, SecureChannel::Role role) {
    if (credentials)
      secure_.emplace(*credentials, role);
  }

  /// Whether it is time to speak.
  bool is_ready() const { return !secure_ || secure_->established(); }

  /// Whether the peer may call itself that.
  bool proves(std::string_view name) const { return !secure_ || secure_->peer_has_name(name); }

  /// Takes what arrived; what the peer has said thereby, which stays valid until the next call, and
  /// no longer than what arrived does.
  std::span<const std::uint8_t> receive(std::span<const std::uint8_t> from_network) {
    if (!secure_)
      return from_network;
    if (!std::exchange(has_heard_, true) && !from_network.empty() &&
        is_begin_of_greeting(static_cast<char>(from_network.front())))
      throw SecurityError(peer_lacks_tls);
    said_.clear();
    secure_->receive(from_network, said_);
    return said_;
  }

  /// Appends what is to be written so that the peer hears `words`, and what else is due.
  void write(std::vector<char> words, std::vector<char>& to_network) {
    if (!secure_) {
      if (to_network.empty())
        to_network.swap(words);
      else
        to_network.insert(to_network.end(), words.begin(), words.end());
      return;
    }
    if (!words.empty())
      secure_->send({reinterpret_cast<const std::uint8_t*>(words.data()), words.size()});
    secure_->take_outgoing(to_network);
  }

private:
  std::optional<SecureChannel> secure_;
  bool has_heard_ = false;
  Bytes said_;
};

} // namespace castor
