#include "castor/wm/memory/working_memory_parts.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace castor::working_memory_parts {

namespace {

void sort_unique(std::vector<FilterIndex::Key>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

bool is_ignored(const WorkingMemoryState& state, const ChangeEvent& event) {
  return state.options.ignored.count(event.address.subarchitecture) > 0;
}

/// What each subscriber is to be told.
using Notices = std::map<std::uint32_t, std::vector<ChangeNotice>>;

void collect_notices(const WorkingMemoryState& state, const ChangeEventPtr& event,
                     const std::vector<FilterIndex::Key>& keys, Notices& notices) {
  for_each_receiver(keys, [&](std::uint32_t number, std::vector<FilterId> ids) {
    notices[number].push_back({event, std::move(ids)});
  });
  // A backlog that merges is to know of the others, too: of all that came here.
  for (auto number : state.behind)
    if (auto& list = notices[number]; list.empty() || list.back().event != event)
      list.push_back({event, {}});
}

void send(Self self, const caf::actor& to, EventFlow::Batch batch) {
  self->state.counters.delivered += batch.size();
  emit_after_sync(self, [to, batch = std::move(batch)]() mutable {
    if (batch.size() == 1)
      caf::anon_send(to, std::move(batch.front()));
    else
      caf::anon_send(to, ChangeNotices{std::move(batch)});
  });
}

void note_whether_behind(WorkingMemoryState& state, std::uint32_t number) {
  if (state.subscribers.at(number).flow.backlog().is_merging())
    state.behind.insert(number);
  else
    state.behind.erase(number);
}

void send_notices(Self self, Notices notices) {
  auto& state = self->state;
  for (auto& [number, list] : notices) {
    auto& subscriber = state.subscribers.at(number);
    for (auto& [event, filters] : list) {
      if (filters.empty())
        continue;
      ++state.counters.matched;
      if (!subscriber.component.empty())
        state.usage.record(subscriber.component, event->address.subarchitecture, event->type_name(),
                           &Usage::events);
    }
    if (auto batch = subscriber.flow.push(std::move(list)))
      send(self, subscriber.actor, *std::move(batch));
    else
      note_whether_behind(state, number);
  }
}

/// Tells the other working memories, and answers when the last of them has taken note.
caf::result<Outcome<Acknowledged>> announce(Self self, const ChangeFilter& filter,
                                            FilterIndex::Key key) {
  auto& state = self->state;
  if (*filter.subarchitecture == state.options.subarchitecture)
    return Outcome<Acknowledged>{Acknowledged{}};
  auto& interest = state.own_interests[filter];
  if (interest.filters.empty()) {
    interest.id = ++state.last_interest;
    state.interests_by_id[interest.id] = &interest;
  }
  interest.filters.push_back(key);
  struct Pending {
    caf::typed_response_promise<Outcome<Acknowledged>> promise;
    std::size_t missing = 0;
  };
  auto concerned = std::count_if(state.peers.begin(), state.peers.end(),
                                 [&](auto& x) { return concerns(filter, x); });
  if (concerned == 0)
    return Outcome<Acknowledged>{Acknowledged{}};
  auto pending = std::make_shared<Pending>();
  pending->promise = self->make_response_promise<Outcome<Acknowledged>>();
  pending->missing = static_cast<std::size_t>(concerned);
  for (auto& peer : state.peers) {
    if (!concerns(filter, peer))
      continue;
    tell_interest(self, peer, filter, interest.id, true)
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

void withdraw(Self self, const ChangeFilter& filter, FilterIndex::Key key) {
  auto& state = self->state;
  auto i = state.own_interests.find(filter);
  if (i == state.own_interests.end())
    return;
  auto& interest = i->second;
  std::erase(interest.filters, key);
  if (!interest.filters.empty())
    return;
  for (auto& peer : state.peers)
    if (concerns(filter, peer))
      tell_interest(self, peer, filter, interest.id, false)
        .then([](Acknowledged) {}, [](const caf::error&) {});
  state.interests_by_id.erase(interest.id);
  state.own_interests.erase(i);
}

constexpr EventStream all_streams[] = {EventStream::component, EventStream::runtime};

std::uint32_t subscriber_number(Self self, const caf::strong_actor_ptr& who,
                                const Subscribe& request) {
  auto& state = self->state;
  auto [i, is_new] = state.subscriber_numbers.try_emplace(
    {caf::actor_cast<caf::actor_addr>(who), request.stream}, 0u);
  if (is_new) {
    i->second = ++state.last_subscriber;
    state.subscribers[i->second] = {
      caf::actor_cast<caf::actor>(who), request.component, EventFlow{request.queue_limit}, {}};
    monitor(self, who);
  }
  return i->second;
}

/// Null if it has none.
const std::uint32_t* find_subscriber(const WorkingMemoryState& state, const caf::actor_addr& who,
                                     EventStream stream) {
  auto i = state.subscriber_numbers.find({who, stream});
  return i == state.subscriber_numbers.end() ? nullptr : &i->second;
}

void remove_filter(Self self, std::uint32_t number, FilterId id) {
  auto& state = self->state;
  auto& [actor, component, flow, filters] = state.subscribers.at(number);
  auto i = filters.find(id);
  if (i == filters.end())
    return;
  state.local_index.erase(key_of(number, id), i->second);
  withdraw(self, i->second, key_of(number, id));
  filters.erase(i);
  flow.erase(id);
  note_whether_behind(state, number);
}

} // namespace

bool concerns(const ChangeFilter& filter, const WorkingMemoryState::Peer& peer) {
  return !peer.lost &&
         (filter.subarchitecture->empty() || *filter.subarchitecture == peer.subarchitecture);
}

void emit(Self self, const std::vector<Change>& changes) {
  auto& state = self->state;
  Notices notices;
  ForwardedChanges forwarded{self};
  for (auto& [event, entry, before] : changes) {
    auto& content = entry->value;
    // Comparing two large values is worth it only if somebody hears of the event.
    bool compared = before == nullptr;
    auto compare = [&, &e = *event, &now = content, &old = before] {
      if (!std::exchange(compared, true))
        e.changed = changed_fields(old->value, now);
    };
    if (state.local_index.wants_changed_fields(*event) ||
        state.peer_index.wants_changed_fields(*event))
      compare();
    auto& local = state.matched;
    local.clear();
    if (!is_ignored(state, *event))
      state.local_index.match(*event, content, local);
    auto& foreign = state.matched_by_peers;
    foreign.clear();
    state.peer_index.match(*event, content, foreign);
    if (!local.empty() || !foreign.empty())
      compare();
    sort_unique(local);
    collect_notices(state, event, local, notices);
    sort_unique(foreign);
    forwarded.add(event, foreign);
  }
  send_notices(self, std::move(notices));
  forwarded.send();
}

void receive_forwarded(Self self, const ForwardedEvents& forwarded) {
  auto& state = self->state;
  auto& keys = state.matched;
  Notices notices;
  for (auto& [event, interests] : forwarded.events) {
    if (is_ignored(state, *event))
      continue;
    keys.clear();
    for (auto id : interests)
      if (auto i = state.interests_by_id.find(id); i != state.interests_by_id.end())
        keys.insert(keys.end(), i->second->filters.begin(), i->second->filters.end());
    sort_unique(keys);
    collect_notices(state, event, keys, notices);
  }
  send_notices(self, std::move(notices));
}

caf::result<Outcome<Acknowledged>> subscribe(Self self, const Subscribe& request) {
  auto& state = self->state;
  if (!self->current_sender())
    return Outcome<Acknowledged>{
      Failure{FailureKind::no_answer, "there is nobody to be told of changes", {}}};
  auto filter = request.filter;
  if (!filter.subarchitecture)
    filter.subarchitecture = state.options.subarchitecture;
  if (auto& of = *filter.subarchitecture;
      !of.empty() && of != state.options.subarchitecture && !find_peer(state, of))
    return Outcome<Acknowledged>{unknown_subarchitecture(state, {of, filter.id})};
  auto number = subscriber_number(self, self->current_sender(), request);
  remove_filter(self, number, request.id);
  state.local_index.insert(key_of(number, request.id), filter);
  state.subscribers.at(number).filters[request.id] = filter;
  return announce(self, filter, key_of(number, request.id));
}

void unsubscribe(Self self, const Unsubscribe& request) {
  auto who = caf::actor_cast<caf::actor_addr>(self->current_sender());
  for (auto stream : all_streams)
    if (auto* number = find_subscriber(self->state, who, stream))
      remove_filter(self, *number, request.id);
}

void acknowledge(Self self, const EventsTaken& taken) {
  auto& state = self->state;
  auto who = caf::actor_cast<caf::actor_addr>(self->current_sender());
  if (auto route = find_route(state, who)) {
    acknowledge_route(self, *route, taken.count);
    return;
  }
  auto* number = find_subscriber(state, who, taken.stream);
  if (!number)
    return;
  auto& [actor, component, flow, filters] = state.subscribers.at(*number);
  flow.acknowledge(taken.count);
  while (auto batch = flow.next()) {
    for (auto& notice : *batch)
      state.counters.coalesced += notice.event->coalesced;
    send(self, actor, *std::move(batch));
  }
  note_whether_behind(state, *number);
}

void end_subscriber(Self self, const caf::actor_addr& who) {
  auto& state = self->state;
  for (auto stream : all_streams) {
    auto* number = find_subscriber(state, who, stream);
    if (!number)
      continue;
    auto& [actor, component, flow, filters] = state.subscribers.at(*number);
    state.counters.suppressed += flow.backlog().suppressed();
    // Nobody waits for what it holds, so its filters need not be looked for there.
    flow = EventFlow{};
    while (!filters.empty())
      remove_filter(self, *number, filters.begin()->first);
    state.subscribers.erase(*number);
    state.subscriber_numbers.erase({who, stream});
  }
}

} // namespace castor::working_memory_parts
