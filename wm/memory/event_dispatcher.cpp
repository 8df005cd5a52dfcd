#include "castor/wm/memory/event_dispatcher.hpp"

#include "castor/base/doorbell.hpp"

#include <algorithm>
#include <memory>

namespace castor {

namespace {

constexpr EventStream all_streams[] = {EventStream::component, EventStream::runtime};

} // namespace

EventDispatcher::EventDispatcher(WorkingMemoryActor::pointer self, JournalOutbox& outbox,
                                 MonitoredActors& monitored, UsageLog& usage,
                                 const WorkingMemoryOptions& options)
  : self_(self), clock_(options.clock), outbox_(outbox), monitored_(monitored), usage_(usage),
    subarchitecture_(options.subarchitecture), peer_deadline_(options.peer_deadline),
    // What is on its way to a former life is nothing that this one has asked for.
    subscriptions_(options.subarchitecture, options.ignored,
                   static_cast<InterestId>((options.incarnation - 1) << 20)),
    peers_(options.broadcast) {}

void EventDispatcher::dispatch(const std::vector<CommittedChange>& changes) {
  Subscriptions::Notices notices;
  PeerRoutes::Outgoing outgoing;
  for (auto& [event, entry, before] : changes) {
    auto& content = entry->value;
    // Comparing two large values is worth it only if somebody hears of the event.
    bool compared = before == nullptr;
    auto compare = [&, &e = *event, &now = content, &old = before] {
      if (!std::exchange(compared, true))
        e.changed = changed_fields(old->value, now);
    };
    if (subscriptions_.wants_changed_fields(*event) || peers_.wants_changed_fields(*event))
      compare();
    auto& local = subscriptions_.match(*event, content);
    auto& foreign = peers_.match(*event, content);
    if (!local.empty() || !foreign.empty())
      compare();
    subscriptions_.collect(event, local, notices);
    peers_.collect(event, foreign, outgoing);
  }
  push(std::move(notices));
  peers_.push(
    std::move(outgoing),
    [this](PeerNumber peer, EventFlow::Batch x) { send_near(peer, std::move(x)); },
    [this](RouteNumber route, RoutedEvents x) { send_far(route, std::move(x)); });
  hold_time_for_backlog();
}

void EventDispatcher::hold_time_for_backlog() {
  if (!clock_)
    return;
  if (!peers_.has_backlog())
    time_hold_.reset();
  else if (!time_hold_)
    time_hold_ = clock_->hold();
}

void EventDispatcher::receive(const ChangeNotices& events) {
  push(subscriptions_.receive(events));
}

void EventDispatcher::push(Subscriptions::Notices notices) {
  RingBatch rings;
  subscriptions_.push(
    std::move(notices), usage_,
    [this](Subscriptions::Number x, EventFlow::Batch batch) { send(x, std::move(batch)); });
}

void EventDispatcher::send(Subscriptions::Number subscriber, EventFlow::Batch batch) {
  outbox_.emit([to = subscriber_actors_.at(subscriber), batch = std::move(batch)]() mutable {
    if (batch.size() == 1)
      caf::anon_send(to, std::move(batch.front()));
    else
      caf::anon_send(to, ChangeNotices{std::move(batch)});
  });
}

void EventDispatcher::send_near(PeerNumber peer, EventFlow::Batch events) {
  outbox_.emit([self = self_, to = peer_actors_[peer], events = std::move(events)]() mutable {
    self->send(to, ChangeNotices{std::move(events)});
  });
}

void EventDispatcher::send_far(RouteNumber route, RoutedEvents events) {
  // With this actor as the sender, to which the outlet sends its acknowledgement.
  outbox_.emit([self = self_, outlet = outlets_[route], events = std::move(events)]() mutable {
    caf::actor_cast<caf::abstract_actor*>(outlet)->enqueue(
      caf::actor_cast<caf::strong_actor_ptr>(self), caf::make_message_id(),
      caf::make_message(std::move(events)), self->context());
  });
}

caf::result<Outcome<Acknowledged>> EventDispatcher::subscribe(const Subscribe& request) {
  if (!self_->current_sender())
    return Outcome<Acknowledged>{Failure{
      FailureKind::no_answer, "a subscription needs a sender, to which its events are sent", {}}};
  auto filter = request.filter;
  if (!filter.subarchitecture)
    filter.subarchitecture = subarchitecture_;
  if (auto& of = *filter.subarchitecture; !of.empty() && of != subarchitecture_ && !find_peer(of))
    return Outcome<Acknowledged>{unknown_subarchitecture({of, filter.id})};
  auto number = subscriber_number(request);
  if (auto former = subscriptions_.unsubscribe(number, request.id))
    withdraw(*former);
  if (auto interest = subscriptions_.subscribe(number, request.id, filter))
    return announce(filter, *interest);
  return Outcome<Acknowledged>{Acknowledged{}};
}

void EventDispatcher::unsubscribe(const Unsubscribe& request) {
  auto who = caf::actor_cast<caf::actor_addr>(self_->current_sender());
  for (auto stream : all_streams)
    if (auto* number = find_subscriber(who, stream))
      if (auto withdrawn = subscriptions_.unsubscribe(*number, request.id))
        withdraw(*withdrawn);
}

void EventDispatcher::acknowledge(const EventsTaken& taken) {
  auto who = caf::actor_cast<caf::actor_addr>(self_->current_sender());
  if (auto route = find_route(who)) {
    peers_.acknowledge(*route, taken.count, [this](RouteNumber x, RoutedEvents events) {
      send_far(x, std::move(events));
    });
    hold_time_for_backlog();
  } else if (auto* number = find_subscriber(who, taken.stream))
    subscriptions_.acknowledge(
      *number, taken.count,
      [this](Subscriptions::Number x, EventFlow::Batch batch) { send(x, std::move(batch)); });
}

Subscriptions::Number EventDispatcher::subscriber_number(const Subscribe& request) {
  auto& who = self_->current_sender();
  auto [i, is_new] =
    subscriber_numbers_.try_emplace({caf::actor_cast<caf::actor_addr>(who), request.stream}, 0u);
  if (is_new) {
    i->second = subscriptions_.add(request.component, request.queue_limit);
    subscriber_actors_[i->second] = caf::actor_cast<caf::actor>(who);
    monitored_.add(who);
  }
  return i->second;
}

const Subscriptions::Number* EventDispatcher::find_subscriber(const caf::actor_addr& who,
                                                              EventStream stream) const {
  auto i = subscriber_numbers_.find({who, stream});
  return i == subscriber_numbers_.end() ? nullptr : &i->second;
}

caf::result<Outcome<Acknowledged>> EventDispatcher::announce(const ChangeFilter& filter,
                                                             InterestId id) {
  struct Pending {
    caf::typed_response_promise<Outcome<Acknowledged>> promise;
    std::size_t missing = 0;
  };
  auto concerned = peers_.concerned(filter);
  if (concerned.empty())
    return Outcome<Acknowledged>{Acknowledged{}};
  auto pending = std::make_shared<Pending>();
  pending->promise = self_->make_response_promise<Outcome<Acknowledged>>();
  pending->missing = concerned.size();
  // Of what a component names it is told that it may not read it; of all there is it gets the rest.
  bool is_named = !filter.subarchitecture->empty();
  for (auto peer : concerned)
    request_interest(peer, filter, id, true)
      .then(
        [pending, is_named](const Outcome<Acknowledged>& x) {
          if (!x && is_named)
            pending->promise.deliver(x);
          else if (--pending->missing == 0)
            pending->promise.deliver(Outcome<Acknowledged>{Acknowledged{}});
        },
        [pending, name = peers_.subarchitecture(peer)](const caf::error&) {
          pending->promise.deliver(Outcome<Acknowledged>{
            Failure{FailureKind::no_answer,
                    "the working memory of " + name + " did not take note of a change filter",
                    {name, {}}}});
        });
  return pending->promise;
}

void EventDispatcher::withdraw(const Subscriptions::WithdrawnInterest& interest) {
  for (auto peer : peers_.concerned(interest.filter))
    request_interest(peer, interest.filter, interest.id, false)
      .then([](const Outcome<Acknowledged>&) {}, [](const caf::error&) {});
}

void EventDispatcher::set_interest(const Interest& interest) {
  set_interest(caf::actor_cast<caf::actor_addr>(self_->current_sender()), interest);
}

void EventDispatcher::set_interest(const caf::actor_addr& from, const Interest& interest) {
  for (PeerNumber i = 0; i < peer_actors_.size(); ++i)
    if (!peers_.is_removed(i) && peer_actors_[i].address() == from) {
      peers_.set_interest(i, interest);
      return;
    }
  // One that is about to take another's place may say so before it is introduced.
  early_interests_.emplace_back(from, interest);
}

caf::result<Acknowledged> EventDispatcher::introduce(const Peers& peers) {
  remove_missing(peers);
  absent_ = peers.absent;
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
    if (name == subarchitecture_ || peers_.find(name))
      continue;
    std::optional<RouteNumber> route;
    if (auto i = peers.routes.find(name); i != peers.routes.end())
      route = find_or_add_route(i->second);
    auto peer = peers_.add(name, route, broadcasts_to_(name));
    peer_actors_.push_back(caf::actor_cast<WorkingMemoryActor>(actor));
    for (auto& [from, interest] : std::exchange(early_interests_, {}))
      set_interest(from, interest);
    subscriptions_.for_each_interest([&](const ChangeFilter& filter, InterestId id) {
      if (!peers_.is_concerned(peer, filter))
        return;
      ++pending->missing;
      request_interest(peer, filter, id, true)
        .then([done](const Outcome<Acknowledged>&) { done(); },
              [done](const caf::error&) { done(); });
    });
  }
  if (pending->missing == 0)
    return Acknowledged{};
  pending->promise = self_->make_response_promise<Acknowledged>();
  return pending->promise;
}

void EventDispatcher::remove_missing(const Peers& peers) {
  for (PeerNumber i = 0; i < peer_actors_.size(); ++i) {
    auto now = peers.working_memories.find(peers_.subarchitecture(i));
    if (!peers_.is_removed(i) &&
        (now == peers.working_memories.end() ||
         now->second != caf::actor_cast<caf::strong_actor_ptr>(peer_actors_[i])))
      peers_.remove(i);
  }
}

const WorkingMemoryActor* EventDispatcher::find_peer(const std::string& subarchitecture) const {
  auto number = peers_.find(subarchitecture);
  return number ? &peer_actors_[*number] : nullptr;
}

Failure EventDispatcher::unknown_subarchitecture(const Address& address) const {
  if (absent_.count(address.subarchitecture) > 0)
    return {FailureKind::working_memory_lost,
            "the working memory of " + address.subarchitecture + " is lost, and not back yet",
            address};
  auto known = subarchitecture_;
  for (auto& name : peers_.subarchitectures())
    known += ", " + name;
  if (address.subarchitecture.empty())
    return {FailureKind::bad_address, "an address without a subarchitecture; there are: " + known,
            address};
  return {FailureKind::unknown_subarchitecture,
          "there is no subarchitecture " + address.subarchitecture + "; there are: " + known,
          address};
}

PeerRoutes::RouteNumber EventDispatcher::find_or_add_route(const caf::strong_actor_ptr& outlet) {
  auto actor = caf::actor_cast<caf::actor>(outlet);
  auto i = std::find(outlets_.begin(), outlets_.end(), actor);
  if (i != outlets_.end())
    return static_cast<RouteNumber>(i - outlets_.begin());
  outlets_.push_back(actor);
  monitored_.add(outlet);
  return peers_.add_route();
}

std::optional<PeerRoutes::RouteNumber>
EventDispatcher::find_route(const caf::actor_addr& who) const {
  auto i =
    std::find_if(outlets_.begin(), outlets_.end(), [&](auto& x) { return x.address() == who; });
  if (i == outlets_.end())
    return std::nullopt;
  return static_cast<RouteNumber>(i - outlets_.begin());
}

void EventDispatcher::end(const caf::actor_addr& who) {
  for (auto stream : all_streams)
    if (auto subscriber = subscriber_numbers_.extract({who, stream})) {
      auto number = subscriber.mapped();
      for (auto& x : subscriptions_.remove(number))
        withdraw(x);
      subscriber_actors_.erase(number);
    }
  if (auto route = find_route(who)) {
    peers_.end_route(*route);
    hold_time_for_backlog();
  }
}

void EventDispatcher::add_to(WorkingMemoryStatus& status) const {
  auto local = subscriptions_.counters();
  auto remote = peers_.counters();
  status.filters = subscriptions_.size();
  status.matched = local.matched;
  status.delivered = local.delivered;
  status.forwarded = remote.forwarded;
  status.routed = remote.routed;
  status.coalesced = local.coalesced + remote.coalesced;
  status.suppressed = local.suppressed + remote.suppressed;
  status.backlog = local.backlog + remote.backlog;
}

} // namespace castor
