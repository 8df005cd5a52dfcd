#include "castor/actors/link/handshake.hpp"

#include "castor/actors/link/session.hpp"
#include "castor/wm/values/encoding.hpp"

#include <algorithm>
#include <array>

namespace castor {

namespace {

/// With the version of everything that is said over a link.
constexpr std::array<std::uint8_t, 8> magic{'C', 'A', 'S', 'T', 'O', 'R', 0, 2};
constexpr std::size_t version_at = 6;
constexpr std::size_t longest = 4096;

} // namespace

void write_greeting(std::vector<char>& out, const Greeting& x) {
  Bytes content;
  Encoder encoder{content};
  if (auto* hello = std::get_if<Hello>(&x)) {
    encoder.put(true);
    encoder.put(hello->node);
    encoder.put(hello->system);
    encoder.put(hello->incarnation);
    encoder.put(hello->process);
    encoder.put(hello->receiver);
    encoder.put(hello->known);
    encoder.put(hello->received);
    encoder.put(hello->attempt);
  } else {
    auto& refusal = std::get<Refusal>(x);
    encoder.put(false);
    encoder.put(refusal.reason.substr(0, longest / 2));
    encoder.put(refusal.final);
  }
  Bytes frame{magic.begin(), magic.end()};
  Encoder{frame}.put(content);
  out.insert(out.end(), frame.begin(), frame.end());
}

bool is_begin_of_greeting(char first) {
  return static_cast<std::uint8_t>(first) == magic.front();
}

std::optional<Greeting> read_greeting(Bytes& bytes) {
  // The record types of TLS: an alert, and a handshake.
  if (!bytes.empty() && (bytes.front() == 0x15 || bytes.front() == 0x16))
    throw LinkError(peer_uses_tls);
  auto known = std::min(bytes.size(), version_at);
  if (!std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(known), magic.begin()))
    throw LinkError("it does not speak Castor's protocol");
  if (bytes.size() < magic.size() + sizeof(std::uint32_t))
    return std::nullopt;
  if (!std::equal(magic.begin(), magic.end(), bytes.begin()))
    throw LinkError("it speaks another version of Castor's protocol");
  Decoder in{std::span{bytes}.subspan(magic.size())};
  std::size_t size = in.take_length();
  if (size > longest)
    throw LinkError("a greeting of " + std::to_string(size) + " bytes");
  if (in.remaining() < size)
    return std::nullopt;
  Decoder content{in.take(size)};
  std::optional<Greeting> result;
  try {
    if (content.take_scalar<std::uint8_t>() != 0) {
      Hello hello;
      content.get(hello.node);
      content.get(hello.system);
      content.get(hello.incarnation);
      content.get(hello.process);
      content.get(hello.receiver);
      content.get(hello.known);
      content.get(hello.received);
      content.get(hello.attempt);
      result = std::move(hello);
    } else {
      Refusal refusal;
      content.get(refusal.reason);
      content.get(refusal.final);
      result = std::move(refusal);
    }
    content.expect_end();
  } catch (const DecodeError& e) {
    throw LinkError(std::string{"a greeting that cannot be read: "} + e.what());
  }
  bytes.erase(bytes.begin(), bytes.end() - static_cast<std::ptrdiff_t>(in.remaining()));
  return result;
}

} // namespace castor
