#include "castor/tools/simulation/simulated_network.hpp"

#include "castor/actors/link/link_end.hpp"
#include "castor/actors/link/send_later.hpp"

#include <caf/event_based_actor.hpp>

#include <algorithm>
#include <memory>
#include <utility>

namespace castor::simulation {

/// To the end of a link, or to who listens: the peer has said something.
struct Heard {
  SimulatedNetwork::Connection from = 0;
  std::vector<char> words;
};

/// There is no such connection any more.
struct HungUp {
  SimulatedNetwork::Connection connection = 0;
};

/// What came of dialling; 0 for nothing.
struct Connected {
  SimulatedNetwork::Connection connection = 0;
};

/// A connection that the peer has made.
struct Adopted {
  SimulatedNetwork::Connection connection = 0;
  Hello hello;
  Bytes received;
};

} // namespace castor::simulation

CASTOR_LOCAL_MESSAGE(castor::simulation::Heard)
CASTOR_LOCAL_MESSAGE(castor::simulation::HungUp)
CASTOR_LOCAL_MESSAGE(castor::simulation::Connected)
CASTOR_LOCAL_MESSAGE(castor::simulation::Adopted)

namespace castor::simulation {

namespace {

/// The end of a link over the simulated network.
class SimulatedLink : public LinkDriver, public std::enable_shared_from_this<SimulatedLink> {
public:
  SimulatedLink(caf::event_based_actor* self, SimulatedNetwork& network, Life life, LinkParts parts,
                std::shared_ptr<LinkRecord> record, std::uint32_t seed)
    : self_(self), network_(network), life_(life), peer_(parts.dial), origin_(now()),
      end_(*this, std::move(parts), std::move(record), seed) {}

  caf::behavior begin() {
    end_.begin();
    auto link = shared_from_this();
    return {
      [link](LinkMessage& x) {
        link->end_.send(std::move(x));
        link->settle();
      },
      [link](const Heard& x) {
        link->end_.receive(x.from,
                           {reinterpret_cast<const std::uint8_t*>(x.words.data()), x.words.size()});
        link->settle();
      },
      [link](const HungUp& x) { link->end_.closed(x.connection); },
      [link](LinkReminder x) {
        link->end_.remind(x);
        link->settle();
      },
      [link](const LinkFault& x) { link->end_.inject(x); },
      [link](const Connected& x) {
        link->connected(x);
        link->settle();
      },
      [link](Adopted& x) {
        link->end_.adopt(x.connection,
                         std::make_shared<Channel>(std::nullopt, SecureChannel::Role::accepts),
                         x.hello, std::move(x.received));
        link->settle();
      },
      [link](const LinkPatience& x) { link->end_.set_patience(x.patience); },
      [link](const CloseLink& x) {
        link->network_.link_closed(link->me());
        link->end_.close(x.reason);
      },
    };
  }

  // -- for the end

  Clock::time_point now() const override { return self_->clock().now(); }
  Clock::time_point origin() const override { return origin_; }
  void remind(LinkReminder of, std::chrono::milliseconds after) override {
    send_later(self_, after, of);
  }
  void dial() override { network_.dial(me(), life_, peer_->port); }
  void listen_to(Connection) override {}
  void close(Connection x) override { network_.close(me(), x); }
  std::vector<char>& output(Connection) override { return output_; }
  void flush(Connection x) override {
    written_ = x;
    if (!output_.empty())
      network_.say(me(), x, std::exchange(output_, {}));
  }
  void quit() override { self_->quit(); }
  caf::execution_unit* context() override { return self_->context(); }

private:
  caf::actor me() const { return caf::actor_cast<caf::actor>(self_); }

  /// The network has taken what was written.
  void settle() {
    while (auto connection = std::exchange(written_, 0))
      end_.transferred(connection, 0);
  }

  void connected(const Connected& x) {
    if (x.connection == 0) {
      end_.not_dialled("nobody listens there");
    } else if (end_.is_silent()) {
      network_.close(me(), x.connection);
      end_.not_dialled("no sign of life");
    } else {
      end_.dialled(x.connection);
    }
  }

  caf::event_based_actor* self_;
  SimulatedNetwork& network_;
  const Life life_;
  const std::optional<Endpoint> peer_;
  const Clock::time_point origin_;
  std::vector<char> output_;
  Connection written_ = 0;
  LinkEnd end_;
};

caf::behavior simulated_link(caf::event_based_actor* self, SimulatedNetwork* network, Life life,
                             const LinkParts& parts, const std::shared_ptr<LinkRecord>& record,
                             std::uint32_t seed) {
  return std::make_shared<SimulatedLink>(self, *network, life, parts, record, seed)->begin();
}

caf::behavior listener(caf::event_based_actor* self, SimulatedNetwork* network,
                       SimulatedNetwork::Route route) {
  auto strangers = std::make_shared<std::map<SimulatedNetwork::Connection, Bytes>>();
  auto me = [self] { return caf::actor_cast<caf::actor>(self); };
  return {
    [=](const Heard& x) {
      auto& said = (*strangers)[x.from];
      said.insert(said.end(), x.words.begin(), x.words.end());
      auto greeting = read_greeting(said);
      if (!greeting)
        return;
      auto received = std::move(said);
      strangers->erase(x.from);
      auto& hello = std::get<Hello>(*greeting);
      auto link = route(hello);
      if (auto* refusal = std::get_if<Refusal>(&link)) {
        std::vector<char> words;
        write_greeting(words, *refusal);
        network->say(me(), x.from, std::move(words));
        network->close(me(), x.from);
        return;
      }
      auto& to = std::get<caf::actor>(link);
      network->hand_over(x.from, to);
      caf::anon_send(to, Adopted{x.from, hello, std::move(received)});
    },
    [=](const HungUp& x) { strangers->erase(x.connection); },
  };
}

} // namespace

std::chrono::milliseconds SimulatedNetwork::latency() {
  if (longest_.count() == 0 || pick(100) >= delayed_)
    return {};
  return std::chrono::milliseconds{1 + pick(std::size_t(longest_.count()))};
}

template <class T>
void SimulatedNetwork::send(End& to, T message) {
  auto& clock = system_.clock();
  to.due = std::max(to.due, clock.now() + latency());
  if (to.due == clock.now())
    caf::anon_send(to.actor, std::move(message));
  else
    clock.schedule_message(
      to.due, caf::actor_cast<caf::strong_actor_ptr>(to.actor),
      caf::make_mailbox_element(nullptr, caf::make_message_id(), {}, std::move(message)));
}

SimulatedNetwork::End* SimulatedNetwork::other_end(const caf::actor& from, Connection x) {
  auto i = connections_.find(x);
  if (i == connections_.end())
    return nullptr;
  return i->second.first.actor == from ? &i->second.second : &i->second.first;
}

caf::actor SimulatedNetwork::listen(std::uint16_t port, Life life, Route route) {
  auto actor = system_.spawn(listener, this, std::move(route));
  listeners_[port] = {actor, life};
  return actor;
}

caf::actor SimulatedNetwork::spawn_link(Life life, LinkParts parts) {
  auto mesh = parts.mesh;
  auto peer = parts.peer;
  auto record = std::make_shared<LinkRecord>(peer);
  parts.self.receiver = peer;
  auto seed = static_cast<std::uint32_t>(random_());
  auto limits = parts.options.session;
  auto result = system_.spawn(simulated_link, this, life, std::move(parts), record, seed);
  mesh->add_link(result, std::move(record), limits);
  return result;
}

void SimulatedNetwork::end(Life life, bool silently) {
  std::erase_if(listeners_, [&](auto& x) { return x.second.life == life; });
  for (auto i = connections_.begin(); i != connections_.end();) {
    auto& [first, second] = i->second;
    auto concerned = first.life == life || second.life == life;
    if (concerned && !silently)
      send(first.life == life ? second : first, HungUp{i->first});
    i = concerned ? connections_.erase(i) : std::next(i);
  }
}

void SimulatedNetwork::dial(const caf::actor& from, Life life, std::uint16_t port) {
  End end{from, life, {}};
  auto to = listeners_.find(port);
  if (to == listeners_.end()) {
    send(end, Connected{});
    return;
  }
  auto& ends = connections_[++last_];
  ends = {end, {to->second.actor, to->second.life, {}}};
  peers_[from] = to->second.life;
  send(ends.first, Connected{last_});
}

std::optional<Life> SimulatedNetwork::peer_of(const caf::actor& link) const {
  auto i = peers_.find(link);
  return i == peers_.end() ? std::nullopt : std::optional{i->second};
}

void SimulatedNetwork::say(const caf::actor& from, Connection x, std::vector<char> words) {
  auto* to = other_end(from, x);
  if (!to)
    return;
  // As it may be cut on its way.
  if (words.size() > 1 && pick(4) == 0) {
    auto cut = words.begin() + 1 + std::ptrdiff_t(pick(words.size() - 1));
    send(*to, Heard{x, {words.begin(), cut}});
    words.erase(words.begin(), cut);
  }
  send(*to, Heard{x, std::move(words)});
}

void SimulatedNetwork::close(const caf::actor& from, Connection x) {
  if (auto* to = other_end(from, x))
    send(*to, HungUp{x});
  connections_.erase(x);
}

void SimulatedNetwork::hand_over(Connection x, const caf::actor& to) {
  if (auto i = connections_.find(x); i != connections_.end()) {
    i->second.second.actor = to;
    peers_[to] = i->second.first.life;
  }
}

} // namespace castor::simulation
