#include "castor/actors/component/lock_guard.hpp"

#include "castor/actors/component/operations.hpp"

namespace castor {

LockGuard::~LockGuard() {
  if (operations_)
    operations_->release_quietly(address_, token_);
}

bool LockGuard::held() const {
  return operations_ && operations_->holds(address_, token_);
}

void LockGuard::unlock() {
  if (auto* operations = std::exchange(operations_, nullptr))
    operations->release(address_, token_);
}

} // namespace castor
