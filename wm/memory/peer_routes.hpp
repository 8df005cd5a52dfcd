#pragma once

#include "castor/wm/events/event_flow.hpp"
#include "castor/wm/filters/filter_index.hpp"
#include "castor/wm/memory/working_memory_messages.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// The other working memories: their interests in events of this one, and the events queued for
/// them. Peers in one other process share a route, on which each event is sent once.
///
/// Sending is left to the caller: `send_near(PeerNumber, EventFlow::Batch)` to a peer in this
/// process, `send_far(RouteNumber, RoutedEvents)` on a route.
class PeerRoutes {
public:
  /// Counted from 0 in the order of addition, and never used twice.
  using PeerNumber = std::uint32_t;
  using RouteNumber = std::size_t;

  /// The events of one write to be sent.
  struct Outgoing {
    /// For peers in this process.
    std::map<PeerNumber, EventFlow::Batch> near;
    std::map<RouteNumber, EventFlow::Batch> far;
  };

  struct Counters {
    /// As in WorkingMemoryStatus.
    std::uint64_t forwarded = 0;
    std::uint64_t routed = 0;
    std::uint64_t coalesced = 0;
    std::uint64_t suppressed = 0;
    std::uint64_t backlog = 0;
  };

  /// With `broadcast`, every event is sent to every peer regardless of interests, on a route once
  /// for each.
  explicit PeerRoutes(bool broadcast) : broadcast_(broadcast) {}

  // -- peers

  RouteNumber add_route();

  /// A peer without a route is in this process.
  PeerNumber add(const std::string& subarchitecture, std::optional<RouteNumber> route,
                 bool gets_broadcasts = true);

  /// Removes a peer that has left the system; its name may be used again for another.
  void remove(PeerNumber peer);
  bool is_removed(PeerNumber peer) const { return peers_[peer].removed; }

  /// The process of the route is lost, with its peers.
  void end_route(RouteNumber route);

  /// The present peer of a subarchitecture.
  std::optional<PeerNumber> find(const std::string& subarchitecture) const;
  const std::string& subarchitecture(PeerNumber peer) const { return peers_[peer].subarchitecture; }

  /// Subarchitectures of the present peers.
  std::vector<std::string> subarchitectures() const;

  /// Peers whose events the filter can match, without lost ones.
  std::vector<PeerNumber> concerned(const ChangeFilter& filter) const;
  bool is_concerned(PeerNumber peer, const ChangeFilter& filter) const;

  /// Adds or withdraws an interest of the peer.
  void set_interest(PeerNumber peer, const Interest& interest);

  // -- events

  bool wants_changed_fields(const ChangeEvent& event) const {
    return interests_.wants_changed_fields(event);
  }

  /// The keys (receiver_keys.hpp) of the interests that match the event, in order; valid until the
  /// next call.
  const std::vector<FilterIndex::Key>& match(const ChangeEvent& event, const Value& content);

  /// Adds an event to `outgoing`.
  void collect(const ChangeEventPtr& event, const std::vector<FilterIndex::Key>& keys,
               Outgoing& outgoing) const;

  template <class Near, class Far>
  void push(Outgoing outgoing, Near&& send_near, Far&& send_far) {
    for (auto& [peer, events] : outgoing.near) {
      counters_.forwarded += events.size();
      send_near(peer, std::move(events));
    }
    for (auto& [route, batch] : outgoing.far)
      if (auto now = routes_[route].flow.push(std::move(batch)))
        send_far(route, routed(routes_[route], *now));
  }

  /// The route has taken `count` events.
  template <class Far>
  void acknowledge(RouteNumber route, std::uint64_t count, Far&& send_far) {
    auto& x = routes_[route];
    x.flow.acknowledge(count);
    while (auto batch = x.flow.next())
      send_far(route, routed(x, *batch));
  }

  Counters counters() const;

  /// Whether events wait until earlier ones have been acknowledged.
  bool has_backlog() const;

private:
  struct PeerInterest {
    ChangeFilter filter;
    /// Its number on the peer's route, if the peer has one.
    std::uint32_t number = 0;
  };

  struct Peer {
    std::string subarchitecture;
    /// Nothing for one in this process.
    std::optional<RouteNumber> route;
    /// Its process is lost.
    bool lost = false;
    bool removed = false;
    std::map<InterestId, PeerInterest> interests;
  };

  struct Route {
    EventFlow flow{route_limit};
    /// Peer and interest for each filter number in the flow.
    std::map<std::uint32_t, std::pair<PeerNumber, InterestId>> receivers;
    std::uint32_t last_number = 0;
  };

  void erase(PeerNumber peer, InterestId id, const PeerInterest& interest);
  void erase_interests(PeerNumber peer);
  /// Converts a batch into the message for the route.
  RoutedEvents routed(const Route& route, const EventFlow::Batch& batch);

  bool broadcast_;
  std::vector<Peer> peers_;
  std::vector<Route> routes_;
  /// Keys: the peer's number above its interest's id.
  FilterIndex interests_;
  /// Without the figures of the flows.
  Counters counters_;
  std::vector<FilterIndex::Key> matched_;
};

} // namespace castor
