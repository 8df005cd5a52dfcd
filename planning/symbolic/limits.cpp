#include "castor/planning/symbolic/limits.hpp"

namespace castor::planning {

std::string to_string(LimitReached limit) {
  switch (limit) {
    case LimitReached::time:
      return "the time is over";
    case LimitReached::memory:
      return "the memory is used up";
    case LimitReached::groundings:
      return "there are too many actions without variables";
    case LimitReached::cancelled:
      return "it was cancelled";
  }
  return "unknown";
}

LimitWatch::LimitWatch(const PlanningLimits& limits) : limits_(limits) {
  // nop
}

void LimitWatch::look() {
  work_ = 0;
  if (limits_.time && Clock::now() - begin_ > *limits_.time)
    throw LimitError(LimitReached::time);
}

} // namespace castor::planning
