#pragma once

#include "castor/tools/simulation/recorder.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace castor::linearizability {

/// What everybody in one simulation shares. All of it runs on one thread.
struct SimulatedWorld {
  struct WorkingMemory {
    std::string subarchitecture;
    WorkingMemoryActor actor;
  };
  struct SimulatedEntry {
    Address address;
    /// Whose it is.
    std::size_t owner = 0;
    /// The last that anybody was told.
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
  /// Operations that the clients may still begin.
  std::size_t operations_left = 0;
  std::int64_t stamps = 0;
  Client last_client = 0;
  /// Components by number.
  std::vector<ClientPtr> identities{nullptr};
  std::vector<caf::actor> alive;
  /// Those of whom not every working memory need have heard that they died.
  std::vector<ClientPtr> dead;
  /// Writes that were made in one.
  std::vector<std::vector<Recorder::Index>> batches;
  /// What is wrong, other than what the checker finds.
  std::vector<std::string> findings;
};

} // namespace castor::linearizability
