// Feeds arbitrary bytes to what hears a link: the greeting, and after it the session. However they
// are cut, they mean the same; whatever is wrong with them is a LinkError. What is sent arrives.

#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/session.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace castor;
using test::require;

// Small enough to be reached by small inputs.
constexpr SessionLimits limits{.chunk = 256,
                               .window = 4096,
                               .largest_message = 1024,
                               .unfinished_messages = 4,
                               .kept_contents = 1000};

/// What one end has heard.
struct Heard {
  bool greeted = false;
  std::vector<IncomingMessage> messages = {};
  std::uint64_t received = 0;
  std::string goodbye = {};
  std::string problem = {};
};

const Bytes& bytes_of(const ReceivedContentPtr& x) {
  return x->bytes();
}

bool same(const Heard& a, const Heard& b) {
  return a.greeted == b.greeted && a.received == b.received && a.goodbye == b.goodbye &&
         a.problem == b.problem &&
         std::equal(a.messages.begin(), a.messages.end(), b.messages.begin(), b.messages.end(),
                    [](auto& x, auto& y) {
                      return x.head == y.head && x.too_large == y.too_large &&
                             std::ranges::equal(x.contents, y.contents, {}, bytes_of, bytes_of);
                    });
}

/// Takes pieces of up to so many bytes.
Heard hear(std::span<const std::uint8_t> data, std::size_t most, std::uint32_t seed) {
  std::minstd_rand random{seed};
  Heard result;
  LinkSession session{limits};
  Bytes greeting;
  auto take = [&](std::span<const std::uint8_t> piece) {
    session.receive(piece, [&](IncomingMessage x) {
      require(x.head.size() <= 64 * 1024);
      result.messages.push_back(std::move(x));
    });
  };
  try {
    while (!data.empty() && session.goodbye().empty()) {
      auto size = std::min<std::size_t>(data.size(), 1 + random() % most);
      auto piece = data.first(size);
      data = data.subspan(size);
      if (result.greeted) {
        take(piece);
        continue;
      }
      greeting.insert(greeting.end(), piece.begin(), piece.end());
      if (read_greeting(greeting)) {
        result.greeted = true;
        take(greeting);
      }
    }
  } catch (const LinkError& e) {
    result.problem = e.what();
  }
  result.received = session.received();
  result.goodbye = session.goodbye();
  return result;
}

/// Sends the bytes as messages, and hears them at the other end.
void talk(std::span<const std::uint8_t> data) {
  LinkSession from{{.chunk = 64}};
  LinkSession to{{.chunk = 64}};
  std::vector<Bytes> heads;
  while (!data.empty()) {
    auto size = std::min<std::size_t>(data.size(), 1 + data.front());
    heads.emplace_back(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(size));
    data = data.subspan(size);
    from.send({heads.back(), {}, 1});
  }
  std::vector<char> out;
  from.produce(out, std::size_t{1} << 30);
  std::vector<Bytes> heard;
  to.receive({reinterpret_cast<const std::uint8_t*>(out.data()), out.size()},
             [&](IncomingMessage x) { heard.push_back(std::move(x.head)); });
  std::sort(heads.begin(), heads.end());
  std::sort(heard.begin(), heard.end());
  require(heads == heard);
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::span<const std::uint8_t> input{data, size};
  auto whole = hear(input, std::max<std::size_t>(size, 1) * 1000, 1);
  auto seed = size > 0 ? input.back() + 1u : 1u;
  require(same(whole, hear(input, 1, seed)));
  require(same(whole, hear(input, 40, seed)));
  talk(input.first(std::min<std::size_t>(size, 2000)));
  return 0;
}
