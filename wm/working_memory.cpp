#include "castor/wm/working_memory.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace castor {

namespace {

using Self = WorkingMemoryActor::stateful_pointer<WorkingMemoryState>;

FilterIndex::Key key_of(std::uint32_t subscriber, FilterId filter) {
  return static_cast<FilterIndex::Key>(subscriber) << 32 | filter;
}

const WorkingMemoryActor* find_peer(const WorkingMemoryState& state, const std::string& name) {
  for (auto& peer : state.peers)
    if (peer.subarchitecture == name)
      return &peer.actor;
  return nullptr;
}

Failure unknown_subarchitecture(const WorkingMemoryState& state, const Address& address) {
  std::string known = state.options.subarchitecture;
  for (auto& peer : state.peers)
    known += ", " + peer.subarchitecture;
  return {FailureKind::unknown_subarchitecture,
          "there is no subarchitecture " + address.subarchitecture + "; there are: " + known,
          address};
}

/// Answers here what is ours, hands on what is another working memory's.
template <class Reply, class Request, class F>
caf::result<Outcome<Reply>> at_owner(Self self, const Address& address, const Request& request,
                                     F&& answer) {
  auto& state = self->state;
  if (address.subarchitecture == state.options.subarchitecture)
    return Outcome<Reply>{answer()};
  if (auto* peer = find_peer(state, address.subarchitecture))
    return self->delegate(*peer, request);
  return Outcome<Reply>{unknown_subarchitecture(state, address)};
}

/// Sends an event to every own component that wants it.
void deliver(WorkingMemoryState& state, const ChangeEventPtr& event, const Value& content) {
  if (state.options.ignored.count(event->address.subarchitecture) > 0)
    return;
  auto& keys = state.matched;
  keys.clear();
  state.local_index.match(*event, content, keys);
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size();) {
    auto number = static_cast<std::uint32_t>(keys[i] >> 32);
    ChangeNotice notice{event, {}};
    for (; i < keys.size() && keys[i] >> 32 == number; ++i)
      notice.filters.push_back(static_cast<FilterId>(keys[i]));
    caf::anon_send(state.subscribers.at(number).actor, std::move(notice));
    ++state.counters.delivered;
  }
}

/// Sends an event of this working memory to every other one that wants it.
void forward(Self self, const ChangeEventPtr& event, const Value& content) {
  auto& state = self->state;
  auto& keys = state.matched;
  keys.clear();
  state.peer_index.match(*event, content, keys);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (auto key : keys) {
    self->send(state.peers[key].actor, ForwardedEvent{event, content});
    ++state.counters.forwarded;
  }
}

Outcome<Version> write(Self self, const WriteRequest& request) {
  auto& state = self->state;
  auto effect = state.store.prepare(request);
  if (!effect) {
    ++state.counters.refused;
    return effect.failure();
  }
  auto version = effect->entry->version;
  auto content = effect->entry->value;
  auto now = std::chrono::duration_cast<Timestamp>(self->clock().now() - state.options.epoch);
  auto event = state.store.commit(*std::move(effect), now);
  deliver(state, event, content);
  forward(self, event, content);
  return version;
}

/// Whether a filter can match events of another subarchitecture's working memory.
bool concerns(const ChangeFilter& filter, const std::string& subarchitecture) {
  return filter.subarchitecture->empty() || *filter.subarchitecture == subarchitecture;
}

/// Tells the other working memories, and answers when the last of them has taken note.
caf::result<Outcome<Acknowledged>> announce(Self self, const ChangeFilter& filter) {
  auto& state = self->state;
  struct Pending {
    caf::typed_response_promise<Outcome<Acknowledged>> promise;
    std::size_t missing = 0;
  };
  auto pending = std::make_shared<Pending>();
  pending->promise = self->make_response_promise<Outcome<Acknowledged>>();
  for (auto& peer : state.peers)
    if (concerns(filter, peer.subarchitecture))
      ++pending->missing;
  if (pending->missing == 0) {
    pending->promise.deliver(Outcome<Acknowledged>{Acknowledged{}});
    return pending->promise;
  }
  ++state.own_interests[filter];
  for (auto& peer : state.peers) {
    if (!concerns(filter, peer.subarchitecture))
      continue;
    self
      ->request(peer.actor, state.options.peer_deadline,
                Interest{state.options.subarchitecture, filter, true})
      .then(
        [pending](Acknowledged) {
          if (--pending->missing == 0)
            pending->promise.deliver(Outcome<Acknowledged>{Acknowledged{}});
        },
        [pending, name = peer.subarchitecture](const caf::error&) {
          pending->promise.deliver(Outcome<Acknowledged>{
            Failure{FailureKind::no_answer,
                    "the working memory of " + name + " did not take note of a change filter",
                    {name, {}}}});
        });
  }
  return pending->promise;
}

void withdraw(Self self, const ChangeFilter& filter) {
  auto& state = self->state;
  auto i = state.own_interests.find(filter);
  if (i == state.own_interests.end() || --i->second > 0)
    return;
  state.own_interests.erase(i);
  for (auto& peer : state.peers)
    if (concerns(filter, peer.subarchitecture))
      self
        ->request(peer.actor, state.options.peer_deadline,
                  Interest{state.options.subarchitecture, filter, false})
        .then([](Acknowledged) {}, [](const caf::error&) {});
}

std::uint32_t subscriber_number(Self self, const caf::strong_actor_ptr& who) {
  auto& state = self->state;
  auto [i, is_new] =
    state.subscriber_numbers.try_emplace(caf::actor_cast<caf::actor_addr>(who), 0u);
  if (is_new) {
    i->second = ++state.last_subscriber;
    state.subscribers[i->second].actor = caf::actor_cast<caf::actor>(who);
    self->monitor(who);
  }
  return i->second;
}

void unsubscribe(Self self, std::uint32_t number, FilterId id) {
  auto& state = self->state;
  auto& filters = state.subscribers.at(number).filters;
  auto i = filters.find(id);
  if (i == filters.end())
    return;
  state.local_index.erase(key_of(number, id), i->second);
  withdraw(self, i->second);
  filters.erase(i);
}

void forget(Self self, const caf::actor_addr& who) {
  auto& state = self->state;
  auto i = state.subscriber_numbers.find(who);
  if (i == state.subscriber_numbers.end())
    return;
  auto& filters = state.subscribers.at(i->second).filters;
  while (!filters.empty())
    unsubscribe(self, i->second, filters.begin()->first);
  state.subscribers.erase(i->second);
  state.subscriber_numbers.erase(i);
}

void set_interest(WorkingMemoryState& state, const Interest& interest) {
  for (std::size_t i = 0; i < state.peers.size(); ++i) {
    if (state.peers[i].subarchitecture != interest.subarchitecture)
      continue;
    auto& interests = state.peer_interests[i];
    if (interest.wanted && interests.insert(interest.filter).second)
      state.peer_index.insert(i, interest.filter);
    else if (!interest.wanted && interests.erase(interest.filter) > 0)
      state.peer_index.erase(i, interest.filter);
  }
}

WorkingMemoryStatus status(const WorkingMemoryState& state) {
  auto result = state.counters;
  result.subarchitecture = state.options.subarchitecture;
  result.entries = state.store.size();
  result.filters = state.local_index.size();
  result.events = state.store.sequence();
  for (auto& entry : state.store.read_by_type({}))
    ++result.entries_by_type[entry->type_name()];
  return result;
}

} // namespace

WorkingMemoryActor::behavior_type working_memory(Self self, WorkingMemoryOptions options) {
  auto& state = self->state;
  state.store = EntryStore{options.subarchitecture, options.store};
  for (auto& writer : options.writers) {
    if (writer == "*")
      state.store.access().allow_all();
    else
      state.store.access().allow(writer);
  }
  state.options = std::move(options);
  self->set_down_handler([self](const caf::down_msg& x) { forget(self, x.source); });
  return {
    [self](const WriteRequest& x) {
      return at_owner<Version>(self, x.address, x, [&] { return write(self, x); });
    },
    [self](const ReadRequest& x) {
      return at_owner<EntryPtr>(self, x.address, x,
                                [&] { return self->state.store.read(x.address.id); });
    },
    [self](const TypeQuery& x) {
      return at_owner<std::vector<EntryPtr>>(self, {x.subarchitecture, {}}, x,
                                             [&] { return self->state.store.read_by_type(x); });
    },
    [self](const ExistsQuery& x) {
      return at_owner<bool>(self, x.address, x,
                            [&] { return self->state.store.exists(x.address.id); });
    },
    [self](const VersionQuery& x) {
      return at_owner<Version>(self, x.address, x,
                               [&] { return self->state.store.version(x.address.id); });
    },
    [self](const Subscribe& x) -> caf::result<Outcome<Acknowledged>> {
      auto& s = self->state;
      auto filter = x.filter;
      if (!filter.subarchitecture)
        filter.subarchitecture = s.options.subarchitecture;
      auto number = subscriber_number(self, self->current_sender());
      unsubscribe(self, number, x.id);
      s.local_index.insert(key_of(number, x.id), filter);
      s.subscribers.at(number).filters[x.id] = filter;
      return announce(self, filter);
    },
    [self](const Unsubscribe& x) {
      auto i = self->state.subscriber_numbers.find(
        caf::actor_cast<caf::actor_addr>(self->current_sender()));
      if (i != self->state.subscriber_numbers.end())
        unsubscribe(self, i->second, x.id);
    },
    [self](const Interest& x) {
      set_interest(self->state, x);
      return Acknowledged{};
    },
    [self](const ForwardedEvent& x) { deliver(self->state, x.event, x.content); },
    [self](const Peers& x) {
      auto& s = self->state;
      for (auto& [name, actor] : x.working_memories) {
        if (name == s.options.subarchitecture || find_peer(s, name))
          continue;
        s.peers.push_back({name, caf::actor_cast<WorkingMemoryActor>(actor)});
        s.peer_interests.emplace_back();
      }
      return Acknowledged{};
    },
    [self](const StatusQuery&) { return status(self->state); },
  };
}

} // namespace castor
