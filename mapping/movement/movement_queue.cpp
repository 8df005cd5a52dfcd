#include "castor/mapping/movement/movement_queue.hpp"

namespace castor::mapping {

void MovementQueue::arrive(const Address& action, MovementPriority priority) {
  if (priority == MovementPriority::urgent) {
    cleared_.insert(waiting_.begin(), waiting_.end());
    waiting_.clear();
    is_cleared_ = runs_.has_value() && runs_ != action;
  }
  if (runs_ != action)
    waiting_.insert(action);
}

bool MovementQueue::begin(const Address& action) {
  waiting_.erase(action);
  if (cleared_.erase(action) > 0)
    return false;
  runs_ = action;
  return true;
}

void MovementQueue::end() {
  runs_.reset();
  is_cleared_ = false;
}

} // namespace castor::mapping
