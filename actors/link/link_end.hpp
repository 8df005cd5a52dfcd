#pragma once

#include "castor/actors/link/channel.hpp"
#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/link/link_parts.hpp"

#include <caf/fwd.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace castor {

/// Timers of the end of a link.
enum class LinkReminder : std::uint8_t {
  /// Check the connection, and send a heartbeat.
  tick,
  /// Make a new connection.
  dial,
  /// Write delayed output.
  delayed,
};

/// Network, clock and timers for the end of a link.
class LinkDriver {
public:
  using Clock = std::chrono::steady_clock;
  using Connection = std::int64_t;

  virtual ~LinkDriver() = default;

  virtual Clock::time_point now() const = 0;
  /// Ends tick at whole heartbeats from here on: all those of a machine at the same time, so that
  /// it has to wake up only once for them.
  virtual Clock::time_point origin() const { return {}; }
  virtual void remind(LinkReminder of, std::chrono::milliseconds after) = 0;
  /// Tries to connect with the peer; to be followed by `LinkEnd::dialled` or `not_dialled`.
  virtual void dial() = 0;
  /// Passes what arrives over the connection to `LinkEnd::receive` from now on.
  virtual void listen_to(Connection x) = 0;
  virtual void close(Connection x) = 0;
  /// Output buffer of the connection.
  virtual std::vector<char>& output(Connection x) = 0;
  virtual void flush(Connection x) = 0;
  /// Ends the link.
  virtual void quit() = 0;
  /// Execution unit for the messages that the link delivers.
  virtual caf::execution_unit* context() = 0;
};

/// One end of a link: manages its connection, and converts messages to and from bytes. Pure but for
/// the driver, and for the mesh, to which it delivers.
class LinkEnd {
public:
  using Clock = LinkDriver::Clock;
  using Connection = LinkDriver::Connection;

  /// The driver has to outlive it. `seed` is that of its random numbers.
  LinkEnd(LinkDriver& driver, LinkParts parts, std::shared_ptr<LinkRecord> record,
          std::uint32_t seed)
    : driver_(driver), parts_(std::move(parts)), record_(std::move(record)),
      session_(parts_.options.session), down_since_(driver_.now()), random_(seed) {}

  void begin();

  /// Sends a message to the peer.
  void send(LinkMessage x);
  /// Sends a goodbye, and ends the link.
  void close(const std::string& reason);
  void remind(LinkReminder of);
  void inject(const LinkFault& x);
  void set_patience(std::chrono::milliseconds x) { parts_.options.patience = x; }

  // -- events of connections

  /// Whether an injected silence is in effect.
  bool is_silent();
  void dialled(Connection x);
  void not_dialled(const std::string& problem) { disconnected(problem); }
  /// Takes over a connection that the peer has made, with the bytes received over it so far.
  void adopt(Connection x, std::shared_ptr<Channel> channel, const Hello& hello, Bytes received);
  void receive(Connection from, std::span<const std::uint8_t> bytes);
  /// `remaining` written bytes are still in the connection's buffer.
  void transferred(Connection x, std::size_t remaining);
  void closed(Connection x);

private:
  using Milliseconds = std::chrono::milliseconds;

  void dial();
  void begin_connection(Connection x, std::shared_ptr<Channel> channel);
  void drop_connection();
  void disconnected(const std::string& why);
  void lost(const std::string& why);
  void try_flush();
  template <class F>
  void guarded(F&& f);

  bool loses_next();
  void write_delayed();
  void write(std::vector<char> bytes);
  void write_now(std::vector<char> bytes);

  void established(const Hello& x);
  void read_hello();
  void read(std::span<const std::uint8_t> bytes);
  void flush();

  /// Whether messages pass, or may be answered soon, so that the peer is to be heard often.
  bool is_awake(Clock::time_point now) const;
  /// A message passes.
  void wake(Clock::time_point now);
  /// Whether this process awaits an answer of the peer.
  bool awaits() const;
  Milliseconds resting_heartbeat(bool awaits) const;
  /// Says when the peer will hear of this end again, which rests.
  void announce(Clock::time_point now);
  Milliseconds rest(Clock::time_point now) const;
  Milliseconds patience_at_rest() const;
  void tick();
  void schedule_tick(Clock::time_point now, Milliseconds after);
  bool misses_peer(Clock::time_point now) const;
  void set_state(LinkState state, const std::string& why);

  LinkDriver& driver_;
  LinkParts parts_;
  std::shared_ptr<LinkRecord> record_;
  LinkSession session_;
  std::optional<Connection> connection_;
  /// Whether the peer's hello was received over the present connection.
  bool greeted_ = false;
  /// Whether the link's own hello was sent over it.
  bool hello_sent_ = false;
  bool has_ended_ = false;
  std::shared_ptr<Channel> channel_;
  /// Bytes received before the peer's hello was complete.
  Bytes handshake_input_;
  /// Incarnation of the peer; 0 until it is known.
  std::uint64_t incarnation_ = 0;
  /// Number of the present connection, counted by the side that dials.
  std::uint64_t attempt_ = 0;
  std::unordered_set<std::uint64_t> introduced_types_;
  std::size_t in_buffer_ = 0;
  bool wrote_since_tick_ = false;
  Clock::time_point next_tick_;
  /// When to send the next heartbeat while the link rests.
  Clock::time_point next_announcement_;
  /// Since when the link does not rest, and when it may rest again.
  Clock::time_point awake_since_;
  Clock::time_point awake_until_;
  Clock::time_point last_input_;
  Clock::time_point down_since_;
  std::string reason_;
  Milliseconds backoff_{20};
  Clock::time_point silent_until_;
  FaultTicket silence_ticket_;
  /// Input was discarded during an injected silence, so the connection cannot be used any more.
  bool discarding_input_ = false;
  Clock::time_point delayed_until_;
  Clock::duration delay_{0};
  FaultTicket delay_ticket_;
  /// Delayed output, with the time at which to write it.
  std::deque<std::pair<Clock::time_point, std::vector<char>>> delayed_;
  Clock::time_point lossy_until_;
  std::uint32_t loss_ = 0;
  FaultTicket loss_ticket_;
  std::minstd_rand random_;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkReminder)
