#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/tools/simulation/simulated_network.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace castor::simulation {

/// A working memory in one incarnation.
struct MemoryLife {
  std::uint64_t incarnation = 1;
  Life process = 0;
  WorkingMemoryActor actor;
  /// Number of the journal's session; 0 without a journal.
  std::uint64_t session = 0;
  /// With a journal: the number of the first change of this incarnation, and its initial contents.
  std::uint64_t first_sequence = 0;
  std::shared_ptr<const StoreImage> image;
  /// Whether it knows that it may lack changes acknowledged by its predecessor.
  bool may_lack_changes = false;
  std::uint64_t journal_incarnation = 0;
  JournalOptions journal;
  /// Whether the journal was written without delays by faults.
  bool is_written_in_time = true;
  linearizability::Tick begin = 0;
  linearizability::Tick end = linearizability::never;
  Timestamp end_time{0};

  bool alive() const { return end == linearizability::never; }
};

/// The incarnation of a working memory that made a change; the end if none of these.
std::vector<MemoryLife>::const_iterator life_of(const ChangeEvent& event,
                                                const std::vector<MemoryLife>& lives);

} // namespace castor::simulation
