#pragma once

#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/link.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <variant>
#include <vector>

namespace castor::simulation {

/// Number of a process, unique among all processes on all machines.
using Life = std::size_t;

/// The network between simulated processes: carries the bytes of their links in order, split
/// anywhere and delayed at random. Runs on one thread, under CAF's test coordinator.
class SimulatedNetwork {
public:
  using Connection = std::int64_t;
  using Route = std::function<std::variant<caf::actor, Refusal>(const Hello&)>;

  SimulatedNetwork(caf::actor_system& system, std::mt19937_64& random)
    : system_(system), random_(random) {}

  /// Sets a callback for links that their own process has closed for good.
  void set_on_close(std::function<void(const caf::actor&)> x) { on_close_ = std::move(x); }

  /// Delays this percentage of the messages, by up to `longest`; the others arrive at once.
  void set_delays(unsigned percent, std::chrono::milliseconds longest) {
    delayed_ = percent;
    longest_ = longest;
  }

  /// Accepts connections for a process; returns the listening actor.
  caf::actor listen(std::uint16_t port, Life life, Route route);

  /// Spawns one end of a link in a process.
  caf::actor spawn_link(Life life, LinkParts parts);

  /// Ends a process.
  /// @param silently whether its peers are not notified
  void end(Life life, bool silently);

  /// The process with which a link was connected last, if any.
  std::optional<Life> peer_of(const caf::actor& link) const;

  // -- for links and listeners

  void dial(const caf::actor& from, Life life, std::uint16_t port);
  void say(const caf::actor& from, Connection x, std::vector<char> words);
  void close(const caf::actor& from, Connection x);
  /// Passes a connection from the listener to an actor.
  void hand_over(Connection x, const caf::actor& to);
  void link_closed(const caf::actor& link) { on_close_(link); }

private:
  struct End {
    caf::actor actor;
    Life life = 0;
    /// Arrival time of the last message sent to it.
    std::chrono::steady_clock::time_point due;
  };

  struct Listener {
    caf::actor actor;
    Life life = 0;
  };

  std::size_t pick(std::size_t count) { return random_() % count; }
  std::chrono::milliseconds latency();
  template <class T>
  void send(End& to, T message);
  /// The other end of an actor's connection; null if it is closed.
  End* other_end(const caf::actor& from, Connection x);

  caf::actor_system& system_;
  std::mt19937_64& random_;
  std::function<void(const caf::actor&)> on_close_ = [](const caf::actor&) {};
  unsigned delayed_ = 0;
  std::chrono::milliseconds longest_{0};
  Connection last_ = 0;
  /// The end that dialled, and the other.
  std::map<Connection, std::pair<End, End>> connections_;
  std::map<std::uint16_t, Listener> listeners_;
  std::map<caf::actor, Life> peers_;
};

} // namespace castor::simulation
