#include "castor/wm/memory/peer_routes.hpp"

#include "castor/wm/memory/receiver_keys.hpp"

namespace castor {

using namespace receiver_keys;

namespace {

/// An interest that no working memory has: an event for it was not asked for.
constexpr InterestId nobody = 0;

} // namespace

PeerRoutes::RouteNumber PeerRoutes::add_route() {
  routes_.emplace_back();
  return routes_.size() - 1;
}

PeerRoutes::PeerNumber PeerRoutes::add(const std::string& subarchitecture,
                                       std::optional<RouteNumber> route, bool gets_broadcasts) {
  auto number = static_cast<PeerNumber>(peers_.size());
  auto& peer = peers_.emplace_back();
  peer.subarchitecture = subarchitecture;
  peer.route = route;
  if (broadcast_ && gets_broadcasts)
    set_interest(number, {subarchitecture, nobody, any_change().anywhere(), true});
  return number;
}

void PeerRoutes::remove(PeerNumber peer) {
  peers_[peer].removed = peers_[peer].lost = true;
  erase_interests(peer);
}

void PeerRoutes::end_route(RouteNumber route) {
  for (PeerNumber i = 0; i < peers_.size(); ++i)
    if (peers_[i].route == route) {
      peers_[i].lost = true;
      erase_interests(i);
    }
  auto& ended = routes_[route];
  counters_.suppressed += ended.flow.backlog().suppressed();
  ended.flow = EventFlow{route_limit};
  ended.receivers.clear();
}

std::optional<PeerRoutes::PeerNumber> PeerRoutes::find(const std::string& subarchitecture) const {
  for (PeerNumber i = 0; i < peers_.size(); ++i)
    if (!peers_[i].removed && peers_[i].subarchitecture == subarchitecture)
      return i;
  return std::nullopt;
}

std::vector<std::string> PeerRoutes::subarchitectures() const {
  std::vector<std::string> result;
  for (auto& peer : peers_)
    if (!peer.removed)
      result.push_back(peer.subarchitecture);
  return result;
}

std::vector<PeerRoutes::PeerNumber> PeerRoutes::concerned(const ChangeFilter& filter) const {
  std::vector<PeerNumber> result;
  for (PeerNumber i = 0; i < peers_.size(); ++i)
    if (is_concerned(i, filter))
      result.push_back(i);
  return result;
}

bool PeerRoutes::is_concerned(PeerNumber peer, const ChangeFilter& filter) const {
  auto& x = peers_[peer];
  return !x.lost &&
         (filter.subarchitecture->empty() || *filter.subarchitecture == x.subarchitecture);
}

void PeerRoutes::set_interest(PeerNumber peer, const Interest& interest) {
  auto& [subarchitecture, route, lost, removed, interests] = peers_[peer];
  if (!interest.wanted) {
    if (auto known = interests.extract(interest.id))
      erase(peer, interest.id, known.mapped());
    return;
  }
  auto [known, is_new] = interests.try_emplace(interest.id);
  if (!is_new)
    return;
  known->second.filter = interest.filter;
  if (route) {
    auto& x = routes_[*route];
    x.receivers[++x.last_number] = {peer, interest.id};
    known->second.number = x.last_number;
  }
  interests_.insert(key_of(peer, interest.id), interest.filter);
}

const std::vector<FilterIndex::Key>& PeerRoutes::match(const ChangeEvent& event,
                                                       const Value& content) {
  matched_.clear();
  interests_.match(event, content, matched_);
  sort_unique(matched_);
  return matched_;
}

void PeerRoutes::collect(const ChangeEventPtr& event, const std::vector<FilterIndex::Key>& keys,
                         Outgoing& outgoing) const {
  for_each_receiver(keys, [&](PeerNumber number, InterestIds ids) {
    auto& peer = peers_[number];
    if (!peer.route) {
      outgoing.near[number].push_back({event, std::move(ids)});
      return;
    }
    auto& batch = outgoing.far[*peer.route];
    // The early scheme sent a copy to each, whoever lived where.
    if (broadcast_ || batch.empty() || batch.back().event != event)
      batch.push_back({event, {}});
    for (auto id : ids)
      batch.back().filters.push_back(peer.interests.at(id).number);
  });
  // A backlog that merges is better off if it knows of the others, too.
  for (RouteNumber i = 0; i < routes_.size(); ++i)
    if (routes_[i].flow.backlog().is_merging())
      if (auto& batch = outgoing.far[i]; batch.empty() || batch.back().event != event)
        batch.push_back({event, {}});
}

PeerRoutes::Counters PeerRoutes::counters() const {
  auto result = counters_;
  for (auto& route : routes_) {
    result.backlog += route.flow.backlog().size();
    result.suppressed += route.flow.backlog().suppressed();
  }
  return result;
}

bool PeerRoutes::has_backlog() const {
  return std::any_of(routes_.begin(), routes_.end(),
                     [](auto& x) { return !x.flow.backlog().empty(); });
}

void PeerRoutes::erase(PeerNumber peer, InterestId id, const PeerInterest& interest) {
  if (auto& x = peers_[peer]; x.route) {
    auto& route = routes_[*x.route];
    route.flow.erase(interest.number);
    route.receivers.erase(interest.number);
  }
  interests_.erase(key_of(peer, id), interest.filter);
}

void PeerRoutes::erase_interests(PeerNumber peer) {
  for (auto& [id, interest] : std::exchange(peers_[peer].interests, {}))
    erase(peer, id, interest);
}

RoutedEvents PeerRoutes::routed(const Route& route, const EventFlow::Batch& batch) {
  RoutedEvents result;
  for (auto& [event, numbers] : batch) {
    std::map<PeerNumber, InterestIds> by_peer;
    for (auto number : numbers)
      if (auto i = route.receivers.find(number); i != route.receivers.end())
        by_peer[i->second.first].push_back(i->second.second);
    RoutedEvent routed{event, {}};
    for (auto& [peer, interests] : by_peer)
      routed.receivers.emplace_back(peers_[peer].subarchitecture, std::move(interests));
    counters_.forwarded += routed.receivers.size();
    counters_.coalesced += event->coalesced;
    ++counters_.routed;
    result.events.push_back(std::move(routed));
  }
  return result;
}

} // namespace castor
