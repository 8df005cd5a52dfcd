#include "castor/actors/link/link.hpp"

#include "castor/actors/component/log.hpp"
#include "castor/actors/link/adopt_connection.hpp"
#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/link/send_later.hpp"

#include <caf/atom.hpp>
#include <caf/blocking_actor.hpp>
#include <caf/io/broker.hpp>
#include <caf/io/middleman.hpp>
#include <caf/scoped_actor.hpp>

#include <fmt/core.h>

#include <unistd.h>

#include <algorithm>
#include <deque>
#include <random>
#include <unordered_set>
#include <utility>

namespace castor {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

using TickAtom = caf::atom_constant<caf::atom("tick")>;
using DialAtom = caf::atom_constant<caf::atom("dial")>;
using DelayedAtom = caf::atom_constant<caf::atom("delayed")>;

/// How much may be in the connection's own buffer, where nothing can overtake it any more.
constexpr std::size_t buffered = 192 * 1024;
constexpr std::size_t read_at_once = 128 * 1024;

/// The outcome of dialling: a socket, or -1 and why.
struct Dialled {
  int socket = -1;
  std::string problem;
};

} // namespace

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::Dialled)

namespace castor {

namespace {

struct BrokerState {
  static constexpr const char* name = "link";

  /// Set when the link ends, for threads that dial on its behalf.
  std::shared_ptr<std::atomic<bool>> over = std::make_shared<std::atomic<bool>>(false);

  ~BrokerState() { *over = true; }
};

using Self = caf::io::stateful_broker<BrokerState>;

class Link : public std::enable_shared_from_this<Link> {
public:
  Link(Self* self, LinkParts parts, std::shared_ptr<LinkRecord> record)
    : self_(self), parts_(std::move(parts)), record_(std::move(record)),
      session_(parts_.options.session) {}

  caf::behavior begin() {
    // Without itself as the sender: a broker that ends leaves in its mailbox what it has not looked
    // at, and would live for ever if it was named there.
    send_later(self_, parts_.options.heartbeat, TickAtom::value);
    if (parts_.dial)
      dial_now();
    auto link = shared_from_this();
    return {
      [link](LinkMessage& x) { link->guarded([&] { link->send(std::move(x)); }); },
      [link](const caf::io::new_data_msg& x) { link->receive(x); },
      [link](const caf::io::data_transferred_msg& x) {
        if (x.handle == link->connection_) {
          link->in_buffer_ = x.remaining;
          link->guarded([&] { link->flush(); });
        }
      },
      [link](const caf::io::connection_closed_msg& x) {
        if (x.handle == link->connection_)
          link->disconnected("the connection was closed");
      },
      [link](TickAtom) { link->guarded([&] { link->tick(); }); },
      [link](DialAtom) { link->dial_now(); },
      [link](DelayedAtom) { link->guarded([&] { link->say_delayed(); }); },
      [link](const LinkFault& x) { link->befall(x); },
      [link](const Dialled& x) { link->dialled(x); },
      [link](AdoptConnection& x) { link->adopt(std::move(x)); },
      [link](const LinkPatience& x) { link->parts_.options.patience = x.patience; },
      [link](const CloseLink& x) { link->close(x.reason); },
    };
  }

private:
  // -- connections

  void dial_now() {
    if (is_silent()) {
      send_later(self_, 20ms, DialAtom::value);
      return;
    }
    auto until = parts_.options.connecting;
    self_->system().spawn<caf::detached + caf::hidden>(
      [to = *parts_.dial, until, over = self_->state.over,
       link = caf::actor_cast<caf::actor>(self_)](caf::blocking_actor*) {
        auto result = dial(to, until, [&] { return over->load(); });
        if (auto* socket = std::get_if<int>(&result))
          caf::anon_send(link, Dialled{*socket, {}});
        else
          caf::anon_send(link, Dialled{-1, std::get<std::string>(result)});
      });
  }

  void dialled(const Dialled& x) {
    if (x.socket < 0) {
      disconnected(x.problem);
      return;
    }
    if (is_silent()) {
      ::close(x.socket);
      disconnected("no sign of life");
      return;
    }
    ++attempt_;
    begin_connection(self_->add_scribe(x.socket),
                     std::make_shared<Channel>(parts_.credentials, SecureChannel::Role::dials));
    guarded([this] { say({}); });
  }

  void adopt(AdoptConnection x) {
    auto handle = x.connection->hdl();
    self_->move_scribe(std::move(x.connection));
    // The peer has given that one up before it made the present one.
    if (is_silent() || (x.hello.incarnation == incarnation_ && x.hello.attempt <= attempt_)) {
      self_->close(handle);
      return;
    }
    attempt_ = x.hello.attempt;
    if (connection_)
      drop_connection();
    begin_connection(handle, std::move(x.channel));
    heard_words_ = std::move(x.received);
    guarded([&] {
      say({});
      established(x.hello);
    });
  }

  void begin_connection(caf::io::connection_handle handle, std::shared_ptr<Channel> channel) {
    connection_ = handle;
    channel_ = std::move(channel);
    has_greeted_ = greeted_ = false;
    heard_words_.clear();
    delayed_.clear();
    in_buffer_ = 0;
    heard_ = Clock::now();
    self_->configure_read(handle, caf::io::receive_policy::at_most(read_at_once));
    self_->ack_writes(handle, true);
    self_->trigger(handle);
  }

  void drop_connection() {
    auto handle = *std::exchange(connection_, std::nullopt);
    greeted_ = false;
    self_->close(handle);
  }

  /// Without a connection for now.
  void disconnected(const std::string& why) {
    bool was_up = greeted_;
    if (connection_)
      drop_connection();
    if (was_up) {
      down_since_ = Clock::now();
      backoff_ = 20ms;
    }
    if (!over_ && (was_up || why != reason_))
      tell(LinkState::down, why);
    reason_ = why;
    if (parts_.dial) {
      // With some jitter, so that those who lost each other at once do not meet at once for ever.
      std::uniform_int_distribution<int> jitter{0, static_cast<int>(backoff_.count()) / 2};
      send_later(self_, backoff_ + Milliseconds{jitter(random_)}, DialAtom::value);
      backoff_ = std::min<Milliseconds>(backoff_ * 2, 1000ms);
    }
  }

  /// Without a connection for good.
  void lost(const std::string& why) {
    if (std::exchange(over_, true))
      return;
    if (connection_) {
      session_.say_goodbye(why);
      say_last();
      drop_connection();
    }
    // Whoever waits for an answer learns of the reason first.
    tell(LinkState::lost, why);
    parts_.mesh->end_process(parts_.peer);
    self_->quit();
  }

  void say_last() {
    try {
      flush();
    } catch (const SecurityError&) {
      // Then the peer will find out by itself.
    }
  }

  void close(const std::string& reason) {
    over_ = true;
    if (greeted_) {
      session_.say_goodbye(reason);
      say_last();
    }
    if (connection_)
      drop_connection();
    parts_.mesh->end_process(parts_.peer);
    self_->quit();
  }

  /// Does something with what the peer says, and ends the connection if that cannot be.
  template <class F>
  void guarded(F&& f) {
    try {
      f();
    } catch (const SecurityError& e) {
      // Once it was the right peer, it is the way to it that is at fault.
      if (incarnation_ != 0)
        disconnected(e.what());
      else
        lost(e.what());
    } catch (const LinkError& e) {
      lost(e.what());
    } catch (const DecodeError& e) {
      lost(std::string{"a message that cannot be read: "} + e.what());
    }
  }

  // -- what is made to befall it

  bool is_silent() const { return Clock::now() < silent_until_; }

  void befall(const LinkFault& x) {
    auto until = Clock::now() + x.duration;
    switch (x.kind) {
      case LinkFault::Kind::silence:
        silent_until_ = until;
        break;
      case LinkFault::Kind::delay:
        delayed_until_ = until;
        delay_ = x.by;
        break;
      case LinkFault::Kind::loss:
        lossy_until_ = until;
        loss_ = x.part;
        break;
    }
  }

  /// Whether the next message is one of those that are lost.
  bool is_lost() {
    return Clock::now() < lossy_until_ &&
           std::uniform_int_distribution<std::uint32_t>{1, 1'000'000}(random_) <= loss_;
  }

  void say_delayed() {
    auto now = Clock::now();
    while (connection_ && !delayed_.empty() && delayed_.front().first <= now) {
      auto words = std::move(delayed_.front().second);
      delayed_.pop_front();
      say_now(std::move(words));
    }
  }

  // -- what is said

  void say(std::vector<char> words) {
    bool is_late = Clock::now() < delayed_until_;
    if (!is_late && delayed_.empty()) {
      say_now(std::move(words));
      return;
    }
    // Never before what is on its way.
    auto due = std::max(is_late ? Clock::now() + delay_ : Clock::now(),
                        delayed_.empty() ? Clock::time_point{} : delayed_.back().first);
    in_buffer_ += words.size();
    delayed_.emplace_back(due, std::move(words));
    auto rest = std::chrono::ceil<Milliseconds>(due - Clock::now());
    send_later(self_, std::max(rest, 0ms), DelayedAtom::value);
  }

  /// Says it, after the greeting if that is due.
  void say_now(std::vector<char> words) {
    if (!has_greeted_ && channel_->is_ready()) {
      has_greeted_ = true;
      auto hello = parts_.self;
      hello.known = incarnation_;
      hello.received = session_.received();
      hello.attempt = attempt_;
      write_greeting(words, hello);
    }
    auto& out = self_->wr_buf(*connection_);
    auto before = out.size();
    channel_->write(std::move(words), out);
    in_buffer_ += out.size() - before;
    LinkRecord::add(record_->bytes_out, out.size() - before);
    self_->flush(*connection_);
  }

  void established(const Hello& x) {
    if (parts_.peer_name.empty())
      parts_.peer_name = x.node;
    if (x.node != parts_.peer_name)
      throw LinkError("there is a node " + x.node + " where " + parts_.peer_name + " should be");
    if (!channel_->proves(x.node))
      throw LinkError("its certificate is not for the name " + x.node);
    if (x.system != parts_.self.system)
      throw LinkError("it takes part in another system");
    if ((incarnation_ != 0 && x.incarnation != incarnation_) ||
        (x.known != 0 && x.known != parts_.self.incarnation))
      throw LinkError("it was started again");
    incarnation_ = x.incarnation;
    session_.resume(x.received);
    greeted_ = true;
    backoff_ = 20ms;
    LinkRecord::add(record_->connections, 1);
    tell(LinkState::up, {});
    hear(std::exchange(heard_words_, {}));
    flush();
  }

  void receive(const caf::io::new_data_msg& x) {
    if (x.handle != connection_ || is_silent()) {
      // What was not heard is not made good for but by another connection.
      deaf_ = deaf_ || x.handle == connection_;
      return;
    }
    heard_ = Clock::now();
    LinkRecord::add(record_->bytes_in, x.buf.size());
    std::span bytes{reinterpret_cast<const std::uint8_t*>(x.buf.data()), x.buf.size()};
    guarded([&] {
      auto words = channel_->receive(bytes);
      say({});
      if (greeted_) {
        hear(words);
      } else {
        heard_words_.insert(heard_words_.end(), words.begin(), words.end());
        hear_greeting();
      }
      flush();
    });
  }

  void hear_greeting() {
    auto greeting = read_greeting(heard_words_);
    if (!greeting)
      return;
    if (auto* refusal = std::get_if<Refusal>(&*greeting)) {
      if (refusal->final)
        lost(refusal->reason);
      else
        disconnected(refusal->reason);
      return;
    }
    established(std::get<Hello>(*greeting));
  }

  void hear(std::span<const std::uint8_t> bytes) {
    session_.receive(bytes, [this](IncomingMessage x) {
      LinkRecord::add(record_->messages_in, 1);
      parts_.mesh->receive(parts_.peer, std::move(x), self_->context());
    });
    if (!session_.goodbye().empty())
      lost(session_.goodbye());
  }

  void send(LinkMessage x) {
    if (over_)
      return;
    std::vector<TypeDescriptorPtr> unknown;
    for (auto& type : x.types)
      if (told_types_.insert(type->hash).second)
        unknown.push_back(std::move(type));
    if (!unknown.empty())
      session_.send({parts_.mesh->introduction(unknown)});
    session_.send(std::move(x.message));
    LinkRecord::add(record_->messages_out, 1);
    if (connection_ && is_lost())
      disconnected("what was sent was lost");
    flush();
  }

  void flush() {
    if (!greeted_ || !connection_ || is_silent())
      return;
    while (in_buffer_ < buffered && session_.has_something_to_say()) {
      std::vector<char> words;
      session_.produce(words, buffered - in_buffer_);
      spoke_ = spoke_ || !words.empty();
      say(std::move(words));
    }
    record_->unacknowledged.store(session_.unacknowledged(), std::memory_order_relaxed);
  }

  void tick() {
    if (over_)
      return;
    send_later(self_, parts_.options.heartbeat, TickAtom::value);
    auto now = Clock::now();
    if (connection_ && !is_silent() && std::exchange(deaf_, false))
      disconnected("what was said was not heard");
    if (connection_) {
      if (now - heard_ > (greeted_ ? parts_.options.silence : parts_.options.connecting)) {
        disconnected("no sign of life");
      } else if (greeted_ && !std::exchange(spoke_, false)) {
        session_.remind();
        flush();
        spoke_ = false;
      }
    }
    if (!greeted_ && now - down_since_ > parts_.options.patience)
      lost(fmt::format("it could not be reached for {:g} s{}",
                       std::chrono::duration<double>(parts_.options.patience).count(),
                       reason_.empty() ? "" : " (" + reason_ + ")"));
  }

  void tell(LinkState state, const std::string& why) {
    LinkNews news{parts_.peer, state, why, parts_.peer_name};
    record_->set_news(news);
    if (parts_.on_news)
      parts_.on_news(news);
  }

  Self* self_;
  LinkParts parts_;
  std::shared_ptr<LinkRecord> record_;
  LinkSession session_;
  std::optional<caf::io::connection_handle> connection_;
  /// Whether the peer has introduced itself over the present connection.
  bool greeted_ = false;
  /// Whether the link has introduced itself over it.
  bool has_greeted_ = false;
  bool over_ = false;
  std::shared_ptr<Channel> channel_;
  /// What the peer has said before it was established.
  Bytes heard_words_;
  /// The peer's, once it is known.
  std::uint64_t incarnation_ = 0;
  /// Counts the connections, on the side that makes them.
  std::uint64_t attempt_ = 0;
  std::unordered_set<std::uint64_t> told_types_;
  std::size_t in_buffer_ = 0;
  bool spoke_ = false;
  Clock::time_point heard_;
  Clock::time_point down_since_ = Clock::now();
  std::string reason_;
  Milliseconds backoff_{20};
  Clock::time_point silent_until_;
  /// Something was said that was not heard.
  bool deaf_ = false;
  Clock::time_point delayed_until_;
  Clock::duration delay_{0};
  /// What is said when its time comes.
  std::deque<std::pair<Clock::time_point, std::vector<char>>> delayed_;
  Clock::time_point lossy_until_;
  std::uint32_t loss_ = 0;
  std::minstd_rand random_{std::random_device{}()};
};

caf::behavior link(Self* self, LinkParts parts, std::shared_ptr<LinkRecord> record) {
  return std::make_shared<Link>(self, std::move(parts), std::move(record))->begin();
}

} // namespace

void await_ends(caf::actor_system& system, const std::vector<caf::actor>& actors) {
  caf::scoped_actor self{system};
  for (auto& x : actors)
    if (x)
      self->wait_for(x);
}

caf::actor spawn_link(LinkParts parts) {
  auto mesh = parts.mesh;
  auto peer = parts.peer;
  auto record = std::make_shared<LinkRecord>(peer);
  parts.self.receiver = peer;
  auto result = mesh->system().middleman().spawn_broker(link, std::move(parts), record);
  mesh->add_port(std::make_shared<LinkPort>(mesh, peer, result, std::move(record)));
  return result;
}

} // namespace castor
