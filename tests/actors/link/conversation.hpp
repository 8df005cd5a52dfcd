#pragma once

#include "castor/actors/link/secure_channel.hpp"

#include <gtest/gtest.h>
#include <openssl/err.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

/// Two ends of a connection and the wires between them, which cut what they carry into pieces of
/// random size. Whatever is called must leave OpenSSL's error queue empty.
template <class Dialer = SecureChannel, class Acceptor = SecureChannel>
class Conversation {
public:
  template <class Channel>
  struct End {
    Channel channel;
    /// What the peer has said so far.
    Bytes heard{};
    /// Why nothing more is heard; empty as long as all is well.
    std::string failure{};
    /// All that the wire has brought and will bring, and how much of that has arrived.
    Bytes wire{};
    std::size_t arrived = 0;
    /// A byte of the wire that does not arrive as it was sent.
    std::size_t damaged = std::numeric_limits<std::size_t>::max();
  };

  Conversation(Dialer a, Acceptor b, std::size_t largest_piece = 4096, unsigned seed = 1)
    : dialer{std::move(a)}, acceptor{std::move(b)}, largest_piece_(largest_piece), random_(seed) {}

  /// Goes on until both wires are empty or lead to an end that has failed.
  void carry() {
    bool first = true;
    while (std::exchange(first, false) || is_waiting(dialer) || is_waiting(acceptor)) {
      collect(dialer, acceptor);
      collect(acceptor, dialer);
      if (random_() % 2 == 0)
        deliver(dialer);
      else
        deliver(acceptor);
      collect(dialer, acceptor);
      collect(acceptor, dialer);
    }
  }

  End<Dialer> dialer;
  End<Acceptor> acceptor;

private:
  template <class Channel>
  static bool is_waiting(const End<Channel>& end) {
    return end.failure.empty() && end.arrived < end.wire.size();
  }

  template <class From, class To>
  static void collect(End<From>& from, End<To>& to) {
    std::vector<char> written;
    from.channel.take_outgoing(written);
    to.wire.insert(to.wire.end(), written.begin(), written.end());
  }

  template <class Channel>
  void deliver(End<Channel>& to) {
    if (!is_waiting(to))
      return;
    auto size = std::min(std::uniform_int_distribution<std::size_t>{1, largest_piece_}(random_),
                         to.wire.size() - to.arrived);
    if (to.damaged - to.arrived < size)
      to.wire[to.damaged] ^= static_cast<std::uint8_t>(1 << random_() % 8);
    try {
      to.channel.receive(std::span{to.wire}.subspan(to.arrived, size), to.heard);
    } catch (const SecurityError& error) {
      to.failure = error.what();
    }
    to.arrived += size;
    EXPECT_EQ(ERR_peek_error(), 0u);
  }

  std::size_t largest_piece_;
  std::mt19937 random_;
};

inline Bytes bytes(std::string_view text) {
  return {text.begin(), text.end()};
}

} // namespace castor::test
