#include "castor/actors/link/secure_channel.hpp"
#include "castor/tests/actors/link/certificates.hpp"
#include "castor/tests/actors/link/conversation.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <openssl/err.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

using Role = SecureChannel::Role;

const Credentials& credentials() {
  static const auto result = [] {
    TemporaryFolder folder;
    return Credentials::load(Authority{}.issue(folder / "node", {.common_name = "node"}));
  }();
  return result;
}

Bytes random_bytes(std::mt19937& random, std::size_t size) {
  Bytes result(size);
  std::generate(result.begin(), result.end(), [&] { return static_cast<std::uint8_t>(random()); });
  return result;
}

Conversation<> two_nodes(std::size_t largest_piece, unsigned seed) {
  return {SecureChannel{credentials(), Role::dials}, SecureChannel{credentials(), Role::accepts},
          largest_piece, seed};
}

bool starts_with(const Bytes& whole, const Bytes& part) {
  return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

RC_GTEST_PROP(ASecureChannel, BringsWhatWasSentUnchangedAndInOrderHoweverTheStreamIsCut, ()) {
  auto seed = *rc::gen::arbitrary<unsigned>();
  auto talk = two_nodes(*rc::gen::element<std::size_t>(1, 2, 5, 100, 20'000, 1'000'000), seed);
  talk.carry();
  RC_ASSERT(talk.dialer.channel.established());
  RC_ASSERT(talk.acceptor.channel.established());
  std::mt19937 random{seed};
  Bytes from_dialer;
  Bytes from_acceptor;
  auto sizes = *rc::gen::container<std::vector<std::pair<bool, std::size_t>>>(
    *rc::gen::inRange(0, 12),
    rc::gen::pair(rc::gen::arbitrary<bool>(),
                  rc::gen::element<std::size_t>(0, 1, 100, 16'384, 16'385, 40'000)));
  for (auto [dialer_speaks, size] : sizes) {
    auto& from = dialer_speaks ? talk.dialer.channel : talk.acceptor.channel;
    auto& sent = dialer_speaks ? from_dialer : from_acceptor;
    auto x = random_bytes(random, size);
    from.send(x);
    sent.insert(sent.end(), x.begin(), x.end());
    if (random() % 2 == 0)
      talk.carry();
  }
  talk.carry();
  RC_ASSERT(talk.acceptor.heard == from_dialer);
  RC_ASSERT(talk.dialer.heard == from_acceptor);
}

RC_GTEST_PROP(ASecureChannel, NeverBringsWhatWasDamagedOnTheWay, ()) {
  auto seed = *rc::gen::arbitrary<unsigned>();
  std::mt19937 random{seed};
  auto talk = two_nodes(*rc::gen::element<std::size_t>(1, 100, 20'000), seed);
  talk.carry();
  Bytes sent;
  for (int i = 0; i < 5; ++i) {
    auto x = random_bytes(random, 100);
    talk.dialer.channel.send(x);
    sent.insert(sent.end(), x.begin(), x.end());
  }
  // 5 bytes of header, 1 that tells what is in it, 16 of proof.
  talk.acceptor.damaged = talk.acceptor.wire.size() +
                          *rc::gen::inRange<std::size_t>(0, 5 * std::size_t{5 + 100 + 1 + 16});
  talk.carry();
  // A length that became greater makes it wait for more.
  RC_ASSERT(talk.acceptor.heard.size() < sent.size());
  RC_ASSERT(starts_with(sent, talk.acceptor.heard));
}

RC_GTEST_PROP(ASecureChannel, IsNeverHarmedByADamagedHandshake, ()) {
  auto seed = *rc::gen::arbitrary<unsigned>();
  auto talk = two_nodes(*rc::gen::element<std::size_t>(1, 100, 20'000), seed);
  auto& damaged = *rc::gen::arbitrary<bool>() ? talk.dialer.damaged : talk.acceptor.damaged;
  damaged = *rc::gen::inRange<std::size_t>(0, 1500);
  talk.carry();
  for (auto* channel : {&talk.dialer.channel, &talk.acceptor.channel})
    RC_ASSERT(!channel->established() || channel->peer_has_name("node"));
}

RC_GTEST_PROP(ASecureChannel, IsNeverHarmedByAnything, ()) {
  std::mt19937 random{*rc::gen::arbitrary<unsigned>()};
  SecureChannel channel{credentials(), *rc::gen::element(Role::dials, Role::accepts)};
  Bytes plain;
  std::vector<char> answer;
  // Often what begins like a record of a handshake.
  auto noise = *rc::gen::element(
    Bytes{}, Bytes{0x16, 0x03, 0x01}, Bytes{0x16, 0x03, 0x01, 0x00, 0x20, 0x01},
    Bytes{0x14, 0x03, 0x03, 0x00, 0x01, 0x01}, Bytes{0x15, 0x03, 0x03, 0x00, 0x02});
  auto rest = random_bytes(random, 40'000);
  noise.insert(noise.end(), rest.begin(), rest.end());
  try {
    for (std::span<const std::uint8_t> left{noise}; !left.empty();) {
      auto size = std::min<std::size_t>(left.size(), 1 + random() % 2000);
      channel.receive(left.first(size), plain);
      left = left.subspan(size);
    }
  } catch (const SecurityError&) {
    // As it should be.
  }
  channel.take_outgoing(answer);
  RC_ASSERT(plain.empty());
  RC_ASSERT(!channel.established());
  RC_ASSERT(answer.size() < 10'000u);
  RC_ASSERT(ERR_peek_error() == 0u);
}

} // namespace

} // namespace castor::test
