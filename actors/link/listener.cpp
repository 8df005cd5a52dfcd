#include "castor/actors/link/listener.hpp"

#include "castor/actors/link/adopt_connection.hpp"
#include "castor/actors/link/connection.hpp"
#include "castor/actors/link/link.hpp"
#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/send_later.hpp"
#include "castor/base/log.hpp"

#include <caf/atom.hpp>
#include <caf/io/broker.hpp>
#include <caf/io/middleman.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

namespace {

using Clock = std::chrono::steady_clock;
using TickAtom = caf::atom_constant<caf::atom("tick")>;
using caf::io::connection_handle;

constexpr std::size_t greeting_bytes_at_once = 4096;
constexpr std::chrono::milliseconds period{250};
/// While no connection waits for anything; repeated lines of the log do. It ticks at whole ones, as
/// the links of all processes of a machine do, so that the machine has to wake up only once.
constexpr std::chrono::milliseconds resting_period{2000};

/// A connection that has not said what it wants.
struct Stranger {
  /// Of the machine, or the process on this one.
  std::string address;
  /// 0 on this machine's own sockets.
  std::uint16_t port = 0;
  std::shared_ptr<Channel> channel;
  Bytes received = {};
  /// Whether anything came.
  bool has_sent = false;

  std::string from() const { return port == 0 ? address : address + ':' + std::to_string(port); }
  /// Of this user, such as one that looks whether anybody listens here.
  bool is_own() const { return port == 0; }
};

/// What arrives first over a connection that uses TLS.
constexpr char tls_handshake = 0x16;

class Listener : public std::enable_shared_from_this<Listener> {
public:
  Listener(caf::io::broker* self, ListenerParts parts)
    : self_(self), parts_(std::move(parts)), admission_(parts_.admission) {}

  caf::behavior begin() {
    add_acceptor(*self_,
                 {parts_.socket, farewell(), [](const DescriptorShortage& x) {
                    log_repeated(LogLevel::warning,
                                 "turned away " + std::to_string(x.turned_away) +
                                   " connections: " + x.problem +
                                   "; `ulimit -n` is how many file descriptors a process may have");
                  }});
    schedule_tick(resting_period);
    auto listener = shared_from_this();
    return {
      [listener](const caf::io::new_connection_msg& x) { listener->admit(x.handle); },
      [listener](const caf::io::new_data_msg& x) { listener->read(x); },
      [listener](const caf::io::connection_closed_msg& x) {
        if (auto stranger = listener->forget(x.handle))
          log_repeated(stranger->is_own() ? LogLevel::debug : LogLevel::info,
                       "a connection from " + stranger->from() +
                         " was closed before it introduced itself");
      },
      [listener](const caf::io::acceptor_closed_msg&) {},
      [listener](const ResumeAccepting& x) { listener->self_->trigger(x.acceptor); },
      [listener](TickAtom) { listener->tick(); },
    };
  }

private:
  /// What those are told that the process has no file descriptor for.
  std::vector<char> farewell() const {
    return parts_.credentials ? busy_alert()
                              : as_bytes(Refusal{"it has no file descriptors left", false});
  }

  static std::vector<char> as_bytes(const Refusal& x) {
    std::vector<char> result;
    write_greeting(result, x);
    return result;
  }

  void schedule_tick(std::chrono::milliseconds after) {
    next_tick_ = Clock::now() + after;
    send_later(self_, after, TickAtom::value);
  }

  void admit(connection_handle handle) {
    if (next_tick_ > Clock::now() + period)
      schedule_tick(period);
    // CAF numbers connections by their sockets.
    auto peer = local_peer(static_cast<int>(handle.id()));
    Stranger stranger{peer ? to_string(*peer) : self_->remote_addr(handle),
                      peer ? std::uint16_t{0} : self_->remote_port(handle),
                      std::make_shared<Channel>(parts_.credentials, SecureChannel::Role::accepts)};
    if (peer && !peer->is_of_this_user()) {
      log_repeated(LogLevel::warning,
                   "turned away " + stranger.from() + ": it belongs to another user");
      self_->close(handle);
      return;
    }
    auto out = admission_.admit(handle.id(), stranger.address, Clock::now());
    strangers_.emplace(handle, std::move(stranger));
    self_->configure_read(handle, caf::io::receive_policy::at_most(greeting_bytes_at_once));
    if (out)
      refuse_for_want_of_room(connection_handle::from_int(*out));
  }

  void refuse_for_want_of_room(connection_handle handle) {
    const std::string why = "too many unauthenticated connections";
    say_plainly(handle, parts_.credentials
                          ? busy_alert()
                          : as_bytes(Refusal{why + "; the connection is tried again", false}));
    turn_away(handle, why);
  }

  void read(const caf::io::new_data_msg& x) {
    auto i = strangers_.find(x.handle);
    if (i == strangers_.end() || x.buf.empty())
      return;
    auto& stranger = i->second;
    admission_.has_sent(x.handle.id());
    bool is_first = !std::exchange(stranger.has_sent, true);
    if (is_first && refuse_other_security(x.handle, x.buf.front()))
      return;
    try {
      auto words = stranger.channel->receive(
        {reinterpret_cast<const std::uint8_t*>(x.buf.data()), x.buf.size()});
      stranger.received.insert(stranger.received.end(), words.begin(), words.end());
      write(x.handle, *stranger.channel, {});
      if (auto greeting = read_greeting(stranger.received))
        welcome(x.handle, stranger, *greeting);
    } catch (const SecurityError& e) {
      write(x.handle, *stranger.channel, {});
      turn_away(x.handle, e.what());
    } catch (const LinkError& e) {
      turn_away(x.handle, e.what());
    }
  }

  /// Turns away who uses TLS where nobody does, or does not where everybody has to, and says so in
  /// a way that it understands.
  bool refuse_other_security(connection_handle handle, char first) {
    if (!parts_.credentials && first == tls_handshake) {
      // Whoever expects TLS knows Castor's own greeting (`Channel`).
      say_plainly(handle, as_bytes(Refusal{"it takes no encrypted connections", true}));
      turn_away(handle, peer_uses_tls);
      return true;
    }
    if (parts_.credentials && is_begin_of_greeting(first)) {
      say_plainly(handle,
                  as_bytes(Refusal{"it takes encrypted connections only: start this side with "
                                   "--tls DIR, too (scripts/make-certs makes certificates)",
                                   true}));
      turn_away(handle, peer_lacks_tls);
      return true;
    }
    return false;
  }

  /// Past encryption, if there is any.
  void say_plainly(connection_handle handle, const std::vector<char>& bytes) {
    auto& out = self_->wr_buf(handle);
    out.insert(out.end(), bytes.begin(), bytes.end());
    self_->flush(handle);
  }

  void write(connection_handle handle, Channel& channel, std::vector<char> words) {
    channel.write(std::move(words), self_->wr_buf(handle));
    self_->flush(handle);
  }

  void welcome(connection_handle handle, Stranger& stranger, const Greeting& greeting) {
    auto* hello = std::get_if<Hello>(&greeting);
    if (!hello)
      throw LinkError("it sent a refusal instead of a hello");
    if (!stranger.channel->proves(hello->node))
      throw LinkError("its certificate is not for the name " + hello->node);
    auto link = parts_.route(*hello);
    if (auto* refusal = std::get_if<Refusal>(&link)) {
      std::vector<char> words;
      write_greeting(words, *refusal);
      write(handle, *stranger.channel, std::move(words));
      turn_away(handle, refusal->reason, refusal->final ? LogLevel::warning : LogLevel::debug);
      return;
    }
    give(handle, stranger, *hello, std::get<caf::actor>(link));
  }

  /// Gives a connection to a link, and remembers it until the link has taken it: one that has ended
  /// never does.
  void give(connection_handle handle, Stranger& stranger, const Hello& hello,
            const caf::actor& link) {
    // Nothing may arrive while the connection belongs to nobody.
    self_->halt(handle);
    auto accepted = std::make_shared<AcceptedConnection>(AcceptedConnection{
      self_->take(handle), std::move(stranger.channel), hello, std::move(stranger.received)});
    given_.emplace_back(Clock::now() + parts_.admission.patience, accepted);
    admission_.remember(stranger.address);
    forget(handle);
    caf::anon_send(link, AdoptConnection{std::move(accepted)});
  }

  void take_back_given(Clock::time_point now) {
    std::erase_if(given_, [&](auto& x) {
      auto& [until, accepted] = x;
      if (now > until)
        accepted->connection = nullptr;
      return !accepted->connection;
    });
  }

  void turn_away(connection_handle handle, const std::string& why,
                 LogLevel level = LogLevel::warning) {
    if (auto stranger = forget(handle))
      log_repeated(level, "turned away " + stranger->from() + ": " + why);
    self_->close(handle);
  }

  std::optional<Stranger> forget(connection_handle handle) {
    admission_.remove(handle.id());
    auto node = strangers_.extract(handle);
    return node ? std::optional{std::move(node.mapped())} : std::nullopt;
  }

  void tick() {
    auto now = Clock::now();
    // There are ticks from before a connection came.
    if (now + std::chrono::milliseconds{1} < next_tick_)
      return;
    take_back_given(now);
    for (auto id : admission_.late(now))
      turn_away(connection_handle::from_int(id), "it did not introduce itself in time");
    write_repeated();
    const auto is_resting = strangers_.empty() && given_.empty();
    schedule_tick(is_resting ? std::chrono::ceil<std::chrono::milliseconds>(
                                 resting_period - now.time_since_epoch() % resting_period)
                             : period);
  }

  caf::io::broker* self_;
  ListenerParts parts_;
  Clock::time_point next_tick_;
  Admission admission_;
  std::unordered_map<connection_handle, Stranger> strangers_;
  /// What links may take, and until when.
  std::vector<std::pair<Clock::time_point, std::shared_ptr<AcceptedConnection>>> given_;
};

caf::behavior listener(caf::io::broker* self, ListenerParts parts) {
  return std::make_shared<Listener>(self, std::move(parts))->begin();
}

} // namespace

caf::actor spawn_listener(caf::actor_system& system, ListenerParts parts) {
  return system.middleman().spawn_broker(listener, std::move(parts));
}

} // namespace castor
