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
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// Sends change events to the components and working memories that want them: knows which actors
/// stand behind the numbers of Subscriptions and PeerRoutes.
class EventDispatcher {
public:
  EventDispatcher(WorkingMemoryActor::pointer self, JournalOutbox& outbox,
                  MonitoredActors& monitored, UsageLog& usage, const WorkingMemoryOptions& options);

  /// Sends the events of one write.
  void dispatch(const std::vector<CommittedChange>& changes);

  /// Those of a write in another working memory, to the components here.
  void receive(const ChangeNotices& events);

  // -- of the sender of the current message

  /// Answers once every working memory concerned has taken note.
  caf::result<Outcome<Acknowledged>> subscribe(const Subscribe& request);
  void unsubscribe(const Unsubscribe& request);
  void acknowledge(const EventsTaken& taken);
  void set_interest(const Interest& interest);

  // -- other working memories

  caf::result<Acknowledged> introduce(const Peers& peers);

  /// Null if there is no such subarchitecture, or if it is the own one.
  const WorkingMemoryActor* find_peer(const std::string& subarchitecture) const;
  Failure unknown_subarchitecture(const Address& address) const;

  /// A subscriber or a route, perhaps.
  void end(const caf::actor_addr& who);

  /// Adds what there is to know about filters and events.
  void add_to(WorkingMemoryStatus& status) const;

private:
  using PeerNumber = PeerRoutes::PeerNumber;
  using RouteNumber = PeerRoutes::RouteNumber;

  Subscriptions::Number subscriber_number(const Subscribe& request);
  /// Null if it has none.
  const Subscriptions::Number* find_subscriber(const caf::actor_addr& who,
                                               EventStream stream) const;
  caf::result<Outcome<Acknowledged>> announce(const ChangeFilter& filter, InterestId id);
  void withdraw(const Subscriptions::WithdrawnInterest& interest);
  /// Tells another working memory what is wanted of it, or is not any more; to be followed by
  /// `then`.
  auto tell_interest(PeerNumber peer, const ChangeFilter& filter, InterestId id, bool wanted) {
    return self_->request(peer_actors_[peer], peer_deadline_,
                          Interest{subarchitecture_, id, filter, wanted});
  }
  void set_interest(const caf::actor_addr& from, const Interest& interest);

  RouteNumber find_or_add_route(const caf::strong_actor_ptr& outlet);
  std::optional<RouteNumber> find_route(const caf::actor_addr& who) const;
  /// Removes those that are not part of the system any more, or that another has taken the place
  /// of.
  void remove_missing(const Peers& peers);

  void push(Subscriptions::Notices notices);
  void send(Subscriptions::Number subscriber, EventFlow::Batch batch);
  void send_near(PeerNumber peer, EventFlow::Batch events);
  void send_far(RouteNumber route, RoutedEvents events);

  WorkingMemoryActor::pointer self_;
  JournalOutbox& outbox_;
  MonitoredActors& monitored_;
  UsageLog& usage_;
  std::string subarchitecture_;
  std::chrono::milliseconds peer_deadline_;

  Subscriptions subscriptions_;
  std::map<std::pair<caf::actor_addr, EventStream>, Subscriptions::Number> subscriber_numbers_;
  std::unordered_map<Subscriptions::Number, caf::actor> subscriber_actors_;

  PeerRoutes peers_;
  std::vector<WorkingMemoryActor> peer_actors_;
  /// What takes events to the working memories of another process, by route.
  std::vector<caf::actor> outlets_;
  /// Subarchitectures whose working memories are lost, and may come back.
  std::set<std::string> absent_;
  /// Of working memories that have been introduced to this one, but it not yet to them.
  std::vector<std::pair<caf::actor_addr, Interest>> early_interests_;
};

} // namespace castor
