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

/// A working memory in one of its lives.
struct MemoryLife {
  std::uint64_t incarnation = 1;
  Life process = 0;
  WorkingMemoryActor actor;
  /// How often its journal was opened by then; 0 without one.
  std::uint64_t session = 0;
  /// With a journal: the number of the first change of this life, and what it began with.
  std::uint64_t first_sequence = 0;
  std::shared_ptr<const StoreImage> image;
  /// Whether it began without changes that its predecessor has acknowledged, as far as it knows.
  bool may_lack_changes = false;
  std::uint64_t journal_incarnation = 0;
  JournalOptions journal;
  /// Whether nothing has kept the journal from being written in time.
  bool is_written_in_time = true;
  linearizability::Tick begin = 0;
  linearizability::Tick end = linearizability::never;
  Timestamp end_time{0};

  bool alive() const { return end == linearizability::never; }
};

/// The life of a working memory in which it made a change; the end if in none of these.
std::vector<MemoryLife>::const_iterator life_of(const ChangeEvent& event,
                                                const std::vector<MemoryLife>& lives);

} // namespace castor::simulation
