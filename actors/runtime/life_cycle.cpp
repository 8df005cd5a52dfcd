#include "castor/actors/runtime/life_cycle.hpp"

namespace castor {

bool LifeCycle::try_enter(Phase x) {
  if (commanded_.empty() || commanded_.front() != x)
    return false;
  commanded_.pop_front();
  configuring_ = x == Phase::configure;
  started_ = started_ || x == Phase::start;
  return true;
}

} // namespace castor
