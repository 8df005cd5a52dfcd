#pragma once

#include "castor/wm/filters/filter_index.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/leases/lease_table.hpp"
#include "castor/wm/memory/output_gate.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// The versions and tokens of a working memory without a journal begin at another multiple of this
/// in each of its lives, so that none comes twice for different things.
inline constexpr std::uint64_t numbers_per_life = std::uint64_t{1} << 32;

struct WorkingMemoryOptions {
  std::string subarchitecture;
  /// Subarchitectures whose components may write here besides its own; "*" for all.
  std::set<std::string> writers;
  /// Changes in these subarchitectures are not told to the components of this one.
  std::set<std::string> ignored;
  /// Which of its lives this is. Versions and tokens of a later one are above those of the lives
  /// before, so that nobody takes an entry for one that is gone.
  std::uint64_t incarnation = 1;
  /// The moment that event times count from.
  std::chrono::steady_clock::time_point epoch{};
  /// Every event is sent to every other working memory, wanted or not.
  bool broadcast = false;
  /// How long another working memory may take to take note of a filter.
  std::chrono::milliseconds peer_deadline{5000};
  EntryStoreOptions store;
  LeaseTableOptions leases;
  JournalOptions journal;
  /// The journal, with what it held; without, there is none.
  std::shared_ptr<OpenedJournal> opened_journal;
  /// Who takes JournalWrite and answers with JournalNews, instead of an actor that writes the
  /// journal's file.
  caf::actor journal_writer;
};

struct WorkingMemoryState {
  static constexpr const char* name = "working_memory";

  /// One of a component's streams of events.
  struct Subscriber {
    caf::actor actor;
    /// Empty for one that is no component.
    std::string component;
    EventFlow flow;
    std::unordered_map<FilterId, ChangeFilter> filters;
  };

  /// Something that another working memory wants of this one.
  struct PeerInterest {
    ChangeFilter filter;
    /// What it is called on its route, if it has one.
    std::uint32_t number = 0;
  };

  struct Peer {
    std::string subarchitecture;
    WorkingMemoryActor actor;
    /// Into `routes`; nothing for one in this process.
    std::optional<std::size_t> route;
    /// Its process is.
    bool lost = false;
    /// It is no part of the system any more; its name may come again, for another.
    bool removed = false;
    std::map<InterestId, PeerInterest> interests;
  };

  /// The way to the working memories of another process, which together get one copy of an event.
  struct Route {
    caf::actor outlet;
    EventFlow flow{route_limit};
    /// What the filter numbers in the flow stand for: a peer, as an index, and its interest.
    std::map<std::uint32_t, std::pair<std::uint32_t, InterestId>> receivers;
    std::uint32_t last_number = 0;
  };

  /// What components here want of the other working memories, and which filters that comes from.
  struct OwnInterest {
    InterestId id = 0;
    std::vector<FilterIndex::Key> filters;
  };

  /// An operation that waits for a lease to end: component, incarnation, number.
  using WaitKey = std::tuple<std::string, std::uint64_t, WaitNumber>;

  struct Wait {
    std::string id;
    std::function<void(const SettledWait&)> finish;
    /// Nobody wants to hear any more.
    std::function<void()> forgo;
  };

  WorkingMemoryOptions options;
  EntryStore store{""};

  // -- leases
  LeaseTable leases;
  std::map<WaitKey, Wait> waits;
  /// How far its clock was made to be wrong.
  Timestamp clock_jump{0};
  /// When the alarm clock rings next.
  Timestamp alarm = Timestamp::max();

  // -- who holds something here, or waits, or owns an entry
  std::map<caf::actor_addr, ClientPtr> clients;
  std::set<caf::actor_addr> monitored;

  // -- journal
  /// Null without one.
  caf::actor journal;
  OutputGate gate;
  JournalStatus journal_status;
  /// What event times count from.
  UnixTime began{0};

  // -- events
  /// Filters of the own components; a key is the subscriber's number above its filter's id.
  FilterIndex local_index;
  std::map<std::uint32_t, Subscriber> subscribers;
  std::map<std::pair<caf::actor_addr, EventStream>, std::uint32_t> subscriber_numbers;
  /// Whose events are being merged.
  std::set<std::uint32_t> behind;
  std::uint32_t last_subscriber = 0;
  /// What the other subarchitectures want; a key is the index into `peers` above the interest's id.
  FilterIndex peer_index;
  std::vector<Peer> peers;
  /// Subarchitectures whose working memories are lost, and may come back.
  std::set<std::string> absent;
  std::vector<Route> routes;
  /// Of working memories that have been introduced to this one, but it not yet to them.
  std::vector<std::pair<caf::actor_addr, Interest>> early_interests;
  std::map<ChangeFilter, OwnInterest> own_interests;
  std::unordered_map<InterestId, const OwnInterest*> interests_by_id;
  InterestId last_interest = 0;

  WorkingMemoryStatus counters;
  UsageLog usage;
  std::vector<FilterIndex::Key> matched;
  std::vector<FilterIndex::Key> matched_by_peers;
};

/// The working memory of one subarchitecture.
WorkingMemoryActor::behavior_type
working_memory(WorkingMemoryActor::stateful_pointer<WorkingMemoryState> self,
               WorkingMemoryOptions options);

} // namespace castor
