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

/// What the end of a link wants to be reminded of.
enum class LinkReminder : std::uint8_t {
  /// To look after the connection.
  tick,
  /// To make a new one.
  dial,
  /// To say what was held back.
  delayed,
};

/// What connects the end of a link with the world.
class LinkDriver {
public:
  using Clock = std::chrono::steady_clock;
  using Connection = std::int64_t;

  virtual ~LinkDriver() = default;

  virtual Clock::time_point now() const = 0;
  virtual void remind(LinkReminder of, std::chrono::milliseconds after) = 0;
  /// Tries to connect with the peer; to be followed by `LinkEnd::dialled` or `not_dialled`.
  virtual void dial() = 0;
  /// From now on the link hears what comes over a connection.
  virtual void listen_to(Connection x) = 0;
  virtual void close(Connection x) = 0;
  /// What is to be written.
  virtual std::vector<char>& output(Connection x) = 0;
  virtual void flush(Connection x) = 0;
  /// The link is over.
  virtual void quit() = 0;
  /// For what it delivers.
  virtual caf::execution_unit* context() = 0;
};

/// One end of a link: decides about connections, and turns messages into what is said over them.
/// Pure but for the driver, and for the mesh, to which it delivers.
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

  /// Says it to the peer.
  void send(LinkMessage x);
  /// Says goodbye, and ends.
  void close(const std::string& reason);
  void remind(LinkReminder of);
  void inject(const LinkFault& x);
  void set_patience(std::chrono::milliseconds x) { parts_.options.patience = x; }

  // -- what becomes of connections

  /// Whether no connection can be made, as far as anybody here can see.
  bool is_silent();
  void dialled(Connection x);
  void not_dialled(const std::string& problem) { disconnected(problem); }
  /// One that the peer has made, and what came over it so far.
  void adopt(Connection x, std::shared_ptr<Channel> channel, const Hello& hello, Bytes received);
  void receive(Connection from, std::span<const std::uint8_t> bytes);
  /// So much of what was written is still in the connection's buffer.
  void transferred(Connection x, std::size_t remaining);
  void closed(Connection x);

private:
  using Milliseconds = std::chrono::milliseconds;

  void dial();
  void begin_connection(Connection x, std::shared_ptr<Channel> channel);
  void drop_connection();
  void disconnected(const std::string& why);
  void lost(const std::string& why);
  void say_last();
  template <class F>
  void guarded(F&& f);

  bool loses_next();
  void say_delayed();
  void write(std::vector<char> words);
  void write_now(std::vector<char> words);

  void established(const Hello& x);
  void hear_greeting();
  void read(std::span<const std::uint8_t> bytes);
  void flush();
  void tick();
  void tell(LinkState state, const std::string& why);

  LinkDriver& driver_;
  LinkParts parts_;
  std::shared_ptr<LinkRecord> record_;
  LinkSession session_;
  std::optional<Connection> connection_;
  /// Whether the peer has introduced itself over the present connection.
  bool greeted_ = false;
  /// Whether the link has introduced itself over it.
  bool hello_sent_ = false;
  bool over_ = false;
  std::shared_ptr<Channel> channel_;
  /// What the peer has said before it was established.
  Bytes handshake_input_;
  /// The peer's, once it is known.
  std::uint64_t incarnation_ = 0;
  /// Counts the connections, on the side that makes them.
  std::uint64_t attempt_ = 0;
  std::unordered_set<std::uint64_t> told_types_;
  std::size_t in_buffer_ = 0;
  bool wrote_since_tick_ = false;
  Clock::time_point heard_;
  Clock::time_point down_since_;
  std::string reason_;
  Milliseconds backoff_{20};
  Clock::time_point silent_until_;
  FaultTicket silence_ticket_;
  /// Something was said that was not heard.
  bool discarding_input_ = false;
  Clock::time_point delayed_until_;
  Clock::duration delay_{0};
  FaultTicket delay_ticket_;
  /// What is said when its time comes.
  std::deque<std::pair<Clock::time_point, std::vector<char>>> delayed_;
  Clock::time_point lossy_until_;
  std::uint32_t loss_ = 0;
  FaultTicket loss_ticket_;
  std::minstd_rand random_;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkReminder)
