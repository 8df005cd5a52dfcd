#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

namespace castor {

/// Counts the processes of a system; 0 is its coordinator.
using ProcessNumber = std::uint16_t;

enum class LinkState : std::uint8_t {
  /// There is a connection.
  up,
  /// No connection so far, or it was lost; messages sent meanwhile wait.
  down,
  /// The link has ended: there will be no further connection.
  lost,
};

/// Change of a link's state.
struct LinkNews {
  ProcessNumber peer = 0;
  LinkState state = LinkState::up;
  /// Reason of the change.
  std::string reason;
  /// The peer's name, once it has introduced itself.
  std::string name;
};

/// Snapshot of a link.
struct LinkStatus {
  LinkNews news;
  std::uint64_t messages_out = 0;
  std::uint64_t messages_in = 0;
  std::uint64_t bytes_out = 0;
  std::uint64_t bytes_in = 0;
  /// Change events among the messages.
  std::uint64_t events_out = 0;
  std::uint64_t events_in = 0;
  /// Number of connections made.
  std::uint64_t connections = 0;
  /// Bytes that were sent and that the peer has not acknowledged.
  std::uint64_t unacknowledged = 0;
};

/// State and counters of a link. Safe to use from any thread.
class LinkRecord {
public:
  using Counter = std::atomic<std::uint64_t>;

  explicit LinkRecord(ProcessNumber peer)
    : peer_(peer), news_{peer, LinkState::down, "no answer yet", {}} {}

  ProcessNumber peer() const { return peer_; }

  Counter messages_out{0};
  Counter messages_in{0};
  Counter bytes_out{0};
  Counter bytes_in{0};
  Counter events_out{0};
  Counter events_in{0};
  Counter connections{0};
  Counter unacknowledged{0};

  /// Messages for the peer's actors that were handed over to the link, and those of the peer that
  /// have arrived at their receivers here; without those of clocks.
  Counter sent{0};
  Counter received{0};

  static void add(Counter& to, std::uint64_t n) { to.fetch_add(n, std::memory_order_relaxed); }

  void set_news(LinkNews x) {
    std::lock_guard guard{mutex_};
    news_ = std::move(x);
  }

  LinkStatus status() const {
    LinkStatus result{{},         messages_out, messages_in, bytes_out,     bytes_in,
                      events_out, events_in,    connections, unacknowledged};
    std::lock_guard guard{mutex_};
    result.news = news_;
    return result;
  }

private:
  const ProcessNumber peer_;
  mutable std::mutex mutex_;
  LinkNews news_;
};

} // namespace castor
