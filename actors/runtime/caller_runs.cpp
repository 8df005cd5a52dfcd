#include "castor/actors/runtime/caller_runs.hpp"

#include <algorithm>

namespace castor {

bool CallerRuns::is_working_memory(caf::resumable* x) const {
  return known_ && std::binary_search(known_->begin(), known_->end(), x);
}

} // namespace castor
