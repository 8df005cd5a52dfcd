#pragma once

#include "castor/wm/entry_store.hpp"
#include "castor/wm/filter_index.hpp"
#include "castor/wm/working_memory_protocol.hpp"

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor {

struct WorkingMemoryOptions {
  std::string subarchitecture;
  /// Subarchitectures whose components may write here besides its own; "*" for all.
  std::set<std::string> writers;
  /// Changes in these subarchitectures are not told to the components of this one.
  std::set<std::string> ignored;
  /// The moment that event times count from.
  std::chrono::steady_clock::time_point epoch{};
  /// How long another working memory may take to take note of a filter.
  std::chrono::milliseconds peer_deadline{5000};
  EntryStoreOptions store;
};

struct WorkingMemoryState {
  static constexpr const char* name = "working_memory";

  struct Subscriber {
    caf::actor actor;
    std::unordered_map<FilterId, ChangeFilter> filters;
  };

  struct Peer {
    std::string subarchitecture;
    WorkingMemoryActor actor;
  };

  WorkingMemoryOptions options;
  EntryStore store{""};

  /// Filters of the own components; a key is the subscriber's number above its filter's id.
  FilterIndex local_index;
  std::map<std::uint32_t, Subscriber> subscribers;
  std::unordered_map<caf::actor_addr, std::uint32_t> subscriber_numbers;
  std::uint32_t last_subscriber = 0;

  /// What the other subarchitectures want; a key is an index into `peers`.
  FilterIndex peer_index;
  std::vector<Peer> peers;
  std::vector<std::set<ChangeFilter>> peer_interests;
  /// How many own filters ask the other subarchitectures for the same.
  std::map<ChangeFilter, std::size_t> own_interests;

  WorkingMemoryStatus counters;
  std::vector<FilterIndex::Key> matched;
};

/// The working memory of one subarchitecture.
WorkingMemoryActor::behavior_type
working_memory(WorkingMemoryActor::stateful_pointer<WorkingMemoryState> self,
               WorkingMemoryOptions options);

} // namespace castor
