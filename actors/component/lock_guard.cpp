#include "castor/actors/component/lock_guard.hpp"

#include "castor/actors/runtime/shell.hpp"
#include "castor/base/log.hpp"

namespace castor {

LockGuard::~LockGuard() {
  if (!shell_)
    return;
  if (!shell_->leases().release(address_, token_))
    return;
  try {
    auto outcome = shell_->try_unlock(address_, token_);
    if (!outcome)
      note(LogLevel::warning, shell_->identity().full_name(),
           "a lease did not last as long as its guard: " + outcome.failure().message);
  } catch (const InjectedCrash&) {
    // It comes again where it can be thrown.
  }
}

bool LockGuard::held() const {
  if (!shell_)
    return false;
  auto x = shell_->leases().find(address_);
  return x && x->token == token_ && !x->lost;
}

void LockGuard::unlock() {
  auto* shell = std::exchange(shell_, nullptr);
  if (!shell)
    return;
  if (shell->leases().release(address_, token_))
    value_or_throw(shell->try_unlock(address_, token_));
}

} // namespace castor
