#include "castor/actors/link/listener.hpp"

#include "castor/actors/component/log.hpp"
#include "castor/actors/link/adopt_connection.hpp"
#include "castor/actors/link/connection.hpp"
#include "castor/actors/link/link.hpp"
#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/send_later.hpp"

#include <caf/atom.hpp>
#include <caf/io/broker.hpp>
#include <caf/io/middleman.hpp>

#include <memory>
#include <unordered_map>
#include <utility>

namespace castor {

namespace {

using Clock = std::chrono::steady_clock;
using TickAtom = caf::atom_constant<caf::atom("tick")>;
using caf::io::connection_handle;

constexpr std::size_t read_at_once = 4096;
constexpr std::chrono::milliseconds period{250};

/// A connection that has not said what it wants.
struct Stranger {
  std::string from;
  std::shared_ptr<Channel> channel;
  Bytes received;
  Clock::time_point until;
  /// Of this user, such as one that looks whether anybody listens here.
  bool is_own = false;
};

class Listener : public std::enable_shared_from_this<Listener> {
public:
  Listener(caf::io::broker* self, ListenerParts parts) : self_(self), parts_(std::move(parts)) {}

  caf::behavior begin() {
    add_acceptor(*self_, {parts_.socket, farewell(), [](const DescriptorShortage& x) {
                            note(LogLevel::warning,
                                 "turned away " + std::to_string(x.turned_away) +
                                   " connections: " + x.problem +
                                   "; `ulimit -n` is how many file descriptors a process may have");
                          }});
    send_later(self_, period, TickAtom::value);
    auto listener = shared_from_this();
    return {
      [listener](const caf::io::new_connection_msg& x) { listener->admit(x.handle); },
      [listener](const caf::io::new_data_msg& x) { listener->hear(x); },
      [listener](const caf::io::connection_closed_msg& x) {
        if (auto stranger = listener->strangers_.extract(x.handle))
          note(stranger.mapped().is_own ? LogLevel::debug : LogLevel::info,
               "a connection from " + stranger.mapped().from + " left without a word");
      },
      [listener](const caf::io::acceptor_closed_msg&) {},
      [listener](const ResumeAccepting& x) { listener->self_->trigger(x.acceptor); },
      [listener](TickAtom) { listener->tick(); },
    };
  }

private:
  /// What those are told that the process has no file descriptor for. Over TLS it would take a
  /// handshake.
  std::vector<char> farewell() const {
    std::vector<char> result;
    if (!parts_.credentials)
      write_greeting(result, Refusal{"it has no file descriptors left", false});
    return result;
  }

  void admit(connection_handle handle) {
    // CAF numbers connections by their sockets.
    auto peer = local_peer(static_cast<int>(handle.id()));
    auto from = peer
                  ? to_string(*peer)
                  : self_->remote_addr(handle) + ':' + std::to_string(self_->remote_port(handle));
    if (peer && !peer->is_of_this_user()) {
      note(LogLevel::warning, "turned away " + from + ": it belongs to another user");
      self_->close(handle);
      return;
    }
    if (strangers_.size() >= parts_.most_strangers) {
      note(LogLevel::warning, "turned away " + from + ": too many connections that say nothing");
      self_->close(handle);
      return;
    }
    strangers_[handle] = {
      std::move(from),
      std::make_shared<Channel>(parts_.credentials, SecureChannel::Role::accepts),
      {},
      Clock::now() + parts_.patience,
      peer.has_value()};
    self_->configure_read(handle, caf::io::receive_policy::at_most(read_at_once));
  }

  void hear(const caf::io::new_data_msg& x) {
    auto i = strangers_.find(x.handle);
    if (i == strangers_.end())
      return;
    auto& stranger = i->second;
    try {
      auto words = stranger.channel->receive(
        {reinterpret_cast<const std::uint8_t*>(x.buf.data()), x.buf.size()});
      stranger.received.insert(stranger.received.end(), words.begin(), words.end());
      say(x.handle, *stranger.channel, {});
      if (auto greeting = read_greeting(stranger.received))
        welcome(x.handle, stranger, *greeting);
    } catch (const SecurityError& e) {
      say(x.handle, *stranger.channel, {});
      turn_away(x.handle, e.what());
    } catch (const LinkError& e) {
      turn_away(x.handle, e.what());
    }
  }

  void say(connection_handle handle, Channel& channel, std::vector<char> words) {
    channel.write(std::move(words), self_->wr_buf(handle));
    self_->flush(handle);
  }

  void welcome(connection_handle handle, Stranger& stranger, const Greeting& greeting) {
    auto* hello = std::get_if<Hello>(&greeting);
    if (!hello)
      throw LinkError("it refuses before it is asked");
    if (!stranger.channel->proves(hello->node))
      throw LinkError("its certificate is not for the name " + hello->node);
    auto link = parts_.route(*hello);
    if (auto* refusal = std::get_if<Refusal>(&link)) {
      std::vector<char> words;
      write_greeting(words, *refusal);
      say(handle, *stranger.channel, std::move(words));
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
    given_.emplace_back(Clock::now() + parts_.patience, accepted);
    strangers_.erase(handle);
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
    auto stranger = strangers_.extract(handle);
    if (stranger)
      note(level, "turned away " + stranger.mapped().from + ": " + why);
    self_->close(handle);
  }

  void tick() {
    send_later(self_, period, TickAtom::value);
    auto now = Clock::now();
    take_back_given(now);
    std::vector<connection_handle> late;
    for (auto& [handle, stranger] : strangers_)
      if (now > stranger.until)
        late.push_back(handle);
    for (auto& handle : late)
      turn_away(handle, "it did not say what it wants");
  }

  caf::io::broker* self_;
  ListenerParts parts_;
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
