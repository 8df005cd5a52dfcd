#include "castor/tools/chaos/connection_flood.hpp"

#include "castor/actors/link/handshake.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <deque>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace castor::faults {

namespace {

using Clock = std::chrono::steady_clock;

/// Beyond that, the oldest connection leaves before another one comes.
constexpr std::size_t most_connections = 64;
constexpr std::chrono::milliseconds patience{100};

/// Data sent by the connections, one after the other; half of them send nothing.
const std::array<std::string, 4>& words() {
  static const auto result = [] {
    std::vector<char> greeting;
    write_greeting(greeting, Hello{"stranger", "nobody", 1, 0, 1, 0, 0, 1});
    return std::array<std::string, 4>{
      "", "GET / HTTP/1.1\r\n\r\n", "",
      std::string{greeting.begin(),
                  greeting.begin() + static_cast<std::ptrdiff_t>(greeting.size() / 2)}};
  }();
  return result;
}

} // namespace

ConnectionFlood::ConnectionFlood(Endpoint to, Rate rate)
  : to_(std::move(to)), interval_(std::chrono::nanoseconds{std::chrono::seconds{1000}} /
                                  std::max<std::uint32_t>(rate.per_thousand_seconds, 1)),
    thread_([this] { work(); }) {}

ConnectionFlood::~ConnectionFlood() {
  stop();
}

ConnectionFlood::Counts ConnectionFlood::stop() {
  {
    std::lock_guard guard{mutex_};
    over_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable())
    thread_.join();
  return counts_;
}

void ConnectionFlood::work() {
  std::deque<int> sockets;
  auto leave = [&] {
    close(sockets.front());
    sockets.pop_front();
  };
  auto is_over = [this] {
    std::lock_guard guard{mutex_};
    return over_;
  };
  auto next = Clock::now();
  for (std::size_t number = 0; !is_over(); ++number) {
    if (sockets.size() == most_connections)
      leave();
    auto dialled = dial(to_, PeerTrust::anybody, patience, is_over);
    if (auto* socket = std::get_if<int>(&dialled)) {
      sockets.push_back(*socket);
      auto& text = words().at(number % words().size());
      [[maybe_unused]] auto sent =
        send(*socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      ++counts_.connected;
    } else {
      ++counts_.failed;
    }
    // What was missed is not made up for.
    next = std::max(next + interval_, Clock::now() - interval_);
    std::unique_lock guard{mutex_};
    changed_.wait_until(guard, next, [this] { return over_; });
  }
  while (!sockets.empty())
    leave();
}

} // namespace castor::faults
