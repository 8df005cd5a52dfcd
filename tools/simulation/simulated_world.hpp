#pragma once

#include "castor/tools/simulation/recorder.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/store/entry_table.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace castor::linearizability {

/// State shared by all actors of one simulation, which runs on one thread.
struct SimulatedWorld {
  struct WorkingMemory {
    std::string subarchitecture;
    WorkingMemoryActor actor;
    /// From which clients read without a message, too; null if they do not.
    std::shared_ptr<EntryTable> entries = {};
  };
  struct SimulatedEntry {
    Address address;
    /// Index of its working memory.
    std::size_t owner = 0;
    /// The last token returned to a client.
    Token last_token = 0;
  };

  SimulatedWorld(std::uint64_t seed, Timestamp lease_duration)
    : random(seed), recorder(lease_duration) {}

  std::size_t pick(std::size_t count) { return random() % count; }
  bool chance(unsigned percent) { return pick(100) < percent; }
  void find(std::string what) { findings.push_back(std::move(what)); }

  std::mt19937_64 random;
  Recorder recorder;
  std::vector<WorkingMemory> working_memories;
  std::vector<SimulatedEntry> entries;
  /// Number of operations that the clients may still begin.
  std::size_t operations_left = 0;
  /// How long waiting clients may be overtaken, which claim what they are offered then; or 0.
  Timestamp overtaking{0};
  std::int64_t stamps = 0;
  Client last_client = 0;
  /// Clients by number.
  std::vector<ClientPtr> identities{nullptr};
  std::vector<caf::actor> alive;
  /// Ended clients whose end may be unknown to some working memory.
  std::vector<ClientPtr> dead;
  /// Records of the writes of each batch.
  std::vector<std::vector<Recorder::Index>> batches;
  /// Errors other than those found by the checker.
  std::vector<std::string> findings;
};

} // namespace castor::linearizability
