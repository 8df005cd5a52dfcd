#pragma once

#include "castor/wm/memory/committed_change.hpp"
#include "castor/wm/memory/journal_outbox.hpp"
#include "castor/wm/memory/monitored_actors.hpp"
#include "castor/wm/memory/peer_routes.hpp"
#include "castor/wm/memory/subscriptions.hpp"
#include "castor/wm/memory/working_memory_options.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// Sends change events to the components and working memories that want them: maps the numbers of
/// Subscriptions and PeerRoutes to actors.
class EventDispatcher {
public:
  EventDispatcher(WorkingMemoryActor::pointer self, JournalOutbox& outbox,
                  MonitoredActors& monitored, UsageLog& usage, const WorkingMemoryOptions& options);

  /// Tells which subarchitectures get broadcasts; all of them until then.
  void set_broadcasts_to(std::function<bool(const std::string&)> f) {
    broadcasts_to_ = std::move(f);
  }

  /// Sends the events of one write.
  void dispatch(const std::vector<CommittedChange>& changes);

  /// Sends the events of a write in another working memory to the components of this one.
  void receive(const ChangeNotices& events);

  // -- requests of the sender of the current message

  /// Replies when every working memory concerned has registered the filter.
  caf::result<Outcome<Acknowledged>> subscribe(const Subscribe& request);
  void unsubscribe(const Unsubscribe& request);
  void acknowledge(const EventsTaken& taken);
  void set_interest(const Interest& interest);

  // -- other working memories

  caf::result<Acknowledged> introduce(const Peers& peers);

  /// Null for an unknown subarchitecture, and for the own one.
  const WorkingMemoryActor* find_peer(const std::string& subarchitecture) const;
  Failure unknown_subarchitecture(const Address& address) const;

  /// Removes an actor that has ended, if it was a subscriber or a route.
  void end(const caf::actor_addr& who);

  /// Fills in the fields about filters and events.
  void add_to(WorkingMemoryStatus& status) const;

private:
  using PeerNumber = PeerRoutes::PeerNumber;
  using RouteNumber = PeerRoutes::RouteNumber;

  Subscriptions::Number subscriber_number(const Subscribe& request);
  /// Null if the actor is not a subscriber of the stream.
  const Subscriptions::Number* find_subscriber(const caf::actor_addr& who,
                                               EventStream stream) const;
  caf::result<Outcome<Acknowledged>> announce(const ChangeFilter& filter, InterestId id);
  void withdraw(const Subscriptions::WithdrawnInterest& interest);
  /// Registers or withdraws an interest at another working memory; to be followed by `then`.
  auto request_interest(PeerNumber peer, const ChangeFilter& filter, InterestId id, bool wanted) {
    return self_->request(peer_actors_[peer], peer_deadline_,
                          Interest{subarchitecture_, id, filter, wanted});
  }
  void set_interest(const caf::actor_addr& from, const Interest& interest);

  RouteNumber find_or_add_route(const caf::strong_actor_ptr& outlet);
  std::optional<RouteNumber> find_route(const caf::actor_addr& who) const;
  /// Removes peers that were removed from the system or replaced.
  void remove_missing(const Peers& peers);

  void push(Subscriptions::Notices notices);
  void send(Subscriptions::Number subscriber, EventFlow::Batch batch);
  void send_near(PeerNumber peer, EventFlow::Batch events);
  void send_far(RouteNumber route, RoutedEvents events);

  /// Simulated time stands while events wait for another process.
  void hold_time_for_backlog();

  WorkingMemoryActor::pointer self_;
  /// Null for the real clock.
  std::shared_ptr<SimulatedClock> clock_;
  std::optional<TimeHold> time_hold_;
  JournalOutbox& outbox_;
  MonitoredActors& monitored_;
  UsageLog& usage_;
  std::string subarchitecture_;
  std::chrono::milliseconds peer_deadline_;

  Subscriptions subscriptions_;
  std::map<std::pair<caf::actor_addr, EventStream>, Subscriptions::Number> subscriber_numbers_;
  std::unordered_map<Subscriptions::Number, caf::actor> subscriber_actors_;

  std::function<bool(const std::string&)> broadcasts_to_ = [](const std::string&) { return true; };
  PeerRoutes peers_;
  std::vector<WorkingMemoryActor> peer_actors_;
  /// Actors that forward events to the working memories of another process, by route.
  std::vector<caf::actor> outlets_;
  /// Subarchitectures whose working memories are lost, but may be restarted.
  std::set<std::string> absent_;
  /// Interests of working memories that know this one but have not been introduced to it yet.
  std::vector<std::pair<caf::actor_addr, Interest>> early_interests_;
};

} // namespace castor
