#include "castor/tools/simulation/memory_life.hpp"

#include <algorithm>

namespace castor::simulation {

std::vector<MemoryLife>::const_iterator life_of(const ChangeEvent& event,
                                                const std::vector<MemoryLife>& lives) {
  if (lives.front().session == 0)
    return std::ranges::find(lives, event.version / numbers_per_life + 1, &MemoryLife::incarnation);
  auto later = std::ranges::upper_bound(lives, event.sequence, {}, &MemoryLife::first_sequence);
  return later == lives.begin() ? lives.end() : std::prev(later);
}

} // namespace castor::simulation
