#include "castor/wm/memory/working_memory_parts.hpp"

#include <algorithm>
#include <utility>

namespace castor::working_memory_parts {

namespace {

using Route = WorkingMemoryState::Route;

/// An interest that no working memory has: an event for it was not asked for.
constexpr InterestId nobody = 0;

/// The number by which a route knows an interest of a peer.
std::uint32_t new_number(WorkingMemoryState& state, std::uint32_t peer, InterestId interest) {
  auto& route = state.routes[*state.peers[peer].route];
  route.receivers[++route.last_number] = {peer, interest};
  return route.last_number;
}

void send_batch(Self self, Route& route, const EventFlow::Batch& batch) {
  auto& state = self->state;
  RoutedEvents result;
  for (auto& [event, numbers] : batch) {
    std::map<std::uint32_t, std::vector<InterestId>> by_peer;
    for (auto number : numbers)
      if (auto i = route.receivers.find(number); i != route.receivers.end())
        by_peer[i->second.first].push_back(i->second.second);
    RoutedEvent routed{event, {}};
    for (auto& [peer, interests] : by_peer)
      routed.receivers.emplace_back(state.peers[peer].subarchitecture, std::move(interests));
    state.counters.forwarded += routed.receivers.size();
    state.counters.coalesced += event->coalesced;
    ++state.counters.routed;
    result.events.push_back(std::move(routed));
  }
  // As a message of this actor's, so that the way knows whom to acknowledge it to.
  emit_after_sync(self, [self, outlet = route.outlet, result = std::move(result)]() mutable {
    caf::actor_cast<caf::abstract_actor*>(outlet)->enqueue(
      caf::actor_cast<caf::strong_actor_ptr>(self), caf::make_message_id(),
      caf::make_message(std::move(result)), self->context());
  });
}

std::size_t find_or_make_route(Self self, const caf::strong_actor_ptr& outlet) {
  auto& routes = self->state.routes;
  auto actor = caf::actor_cast<caf::actor>(outlet);
  for (std::size_t i = 0; i < routes.size(); ++i)
    if (routes[i].outlet == actor)
      return i;
  routes.emplace_back().outlet = actor;
  monitor(self, outlet);
  return routes.size() - 1;
}

/// The peer does not want it any more, whose name for it is `id`.
void drop_interest(WorkingMemoryState& state, std::uint32_t number, InterestId id,
                   const WorkingMemoryState::PeerInterest& interest) {
  if (auto& peer = state.peers[number]; peer.route) {
    auto& route = state.routes[*peer.route];
    route.flow.erase(interest.number);
    route.receivers.erase(interest.number);
  }
  state.peer_index.erase(key_of(number, id), interest.filter);
}

void drop_interests(WorkingMemoryState& state, std::uint32_t number) {
  for (auto& [id, interest] : std::exchange(state.peers[number].interests, {}))
    drop_interest(state, number, id, interest);
}

/// Those that are not part of the system any more, or that another has taken the place of.
void forget_removed(WorkingMemoryState& state, const Peers& peers) {
  for (std::uint32_t i = 0; i < state.peers.size(); ++i) {
    auto& peer = state.peers[i];
    auto now = peers.working_memories.find(peer.subarchitecture);
    if (peer.removed || (now != peers.working_memories.end() &&
                         now->second == caf::actor_cast<caf::strong_actor_ptr>(peer.actor)))
      continue;
    peer.removed = peer.lost = true;
    drop_interests(state, i);
  }
}

} // namespace

caf::result<Acknowledged> introduce(Self self, const Peers& peers) {
  auto& state = self->state;
  forget_removed(state, peers);
  state.absent = peers.absent;
  struct Pending {
    caf::typed_response_promise<Acknowledged> promise;
    std::size_t missing = 0;
  };
  auto pending = std::make_shared<Pending>();
  // One that takes no note is out of reach, and will be lost or taken note of when it is back.
  auto done = [pending] {
    if (--pending->missing == 0)
      pending->promise.deliver(Acknowledged{});
  };
  for (auto& [name, actor] : peers.working_memories) {
    if (name == state.options.subarchitecture || find_peer(state, name))
      continue;
    auto& peer = state.peers.emplace_back();
    peer.subarchitecture = name;
    peer.actor = caf::actor_cast<WorkingMemoryActor>(actor);
    if (auto route = peers.routes.find(name); route != peers.routes.end())
      peer.route = find_or_make_route(self, route->second);
    if (state.options.broadcast)
      set_interest(state, peer.actor.address(), {name, nobody, any_change().anywhere(), true});
    for (auto& [from, interest] : std::exchange(state.early_interests, {}))
      set_interest(state, from, interest);
    for (auto& [filter, interest] : state.own_interests) {
      if (!concerns(filter, peer))
        continue;
      ++pending->missing;
      tell_interest(self, peer, filter, interest.id, true)
        .then([done](Acknowledged) { done(); }, [done](const caf::error&) { done(); });
    }
  }
  if (pending->missing == 0)
    return Acknowledged{};
  pending->promise = self->make_response_promise<Acknowledged>();
  return pending->promise;
}

void set_interest(WorkingMemoryState& state, const caf::actor_addr& from,
                  const Interest& interest) {
  // One that is about to take another's place may say so before it is introduced.
  auto found = std::find_if(state.peers.begin(), state.peers.end(),
                            [&](auto& x) { return !x.removed && x.actor.address() == from; });
  if (found == state.peers.end()) {
    state.early_interests.emplace_back(from, interest);
    return;
  }
  auto number = static_cast<std::uint32_t>(found - state.peers.begin());
  if (interest.wanted) {
    auto [known, is_new] = found->interests.try_emplace(interest.id);
    if (!is_new)
      return;
    known->second.filter = interest.filter;
    if (found->route)
      known->second.number = new_number(state, number, interest.id);
    state.peer_index.insert(key_of(number, interest.id), interest.filter);
  } else if (auto known = found->interests.extract(interest.id)) {
    drop_interest(state, number, interest.id, known.mapped());
  }
}

void ForwardedChanges::add(const ChangeEventPtr& event, const std::vector<FilterIndex::Key>& keys) {
  auto& state = self_->state;
  // The early scheme sent a copy to each, whoever lived where.
  bool share = !state.options.broadcast;
  for_each_receiver(keys, [&](std::uint32_t number, std::vector<InterestId> ids) {
    auto& peer = state.peers[number];
    if (!peer.route) {
      near_[number].push_back({event, std::move(ids)});
      return;
    }
    auto& batch = far_[*peer.route];
    if (!share || batch.empty() || batch.back().event != event)
      batch.push_back({event, {}});
    for (auto id : ids)
      batch.back().filters.push_back(peer.interests.at(id).number);
  });
  // A backlog that merges is better off if it knows of the others, too.
  for (std::size_t i = 0; i < state.routes.size(); ++i)
    if (state.routes[i].flow.backlog().is_merging())
      if (auto& batch = far_[i]; batch.empty() || batch.back().event != event)
        batch.push_back({event, {}});
}

void ForwardedChanges::send() {
  auto& state = self_->state;
  for (auto& [number, list] : near_) {
    state.counters.forwarded += list.size();
    emit_after_sync(
      self_, [self = self_, to = state.peers[number].actor, list = std::move(list)]() mutable {
        self->send(to, ForwardedEvents{std::move(list)});
      });
  }
  for (auto& [number, batch] : far_) {
    auto& route = state.routes[number];
    if (auto now = route.flow.push(std::move(batch)))
      send_batch(self_, route, *now);
  }
}

std::optional<std::size_t> find_route(const WorkingMemoryState& state, const caf::actor_addr& who) {
  auto i = std::find_if(state.routes.begin(), state.routes.end(),
                        [&](auto& x) { return x.outlet.address() == who; });
  if (i == state.routes.end())
    return std::nullopt;
  return static_cast<std::size_t>(i - state.routes.begin());
}

void acknowledge_route(Self self, std::size_t route, std::uint64_t count) {
  auto& x = self->state.routes[route];
  x.flow.acknowledge(count);
  while (auto batch = x.flow.next())
    send_batch(self, x, *batch);
}

void end_route(Self self, const caf::actor_addr& who) {
  auto& state = self->state;
  auto route = find_route(state, who);
  if (!route)
    return;
  for (std::uint32_t i = 0; i < state.peers.size(); ++i) {
    auto& peer = state.peers[i];
    if (peer.route != route)
      continue;
    peer.lost = true;
    drop_interests(state, i);
  }
  auto& ended = state.routes[*route];
  state.counters.suppressed += ended.flow.backlog().suppressed();
  ended.flow = EventFlow{route_limit};
  ended.receivers.clear();
}

} // namespace castor::working_memory_parts
