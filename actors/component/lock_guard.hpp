#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/lease.hpp"

#include <utility>

namespace castor {

class Operations;

/// A lease that the component holds, released when the guard goes out of scope.
///
/// The runtime renews the lease while the component is alive and responsive. If the lease is lost
/// nevertheless, writes under it are refused with LeaseLostException, `held()` turns false as soon
/// as this process knows, `unlock()` throws, and the destructor logs the loss.
class [[nodiscard]] LockGuard {
public:
  /// Made by the components' `lock` and `try_lock`.
  LockGuard(Operations& operations, Address address, LeaseToken token)
    : operations_(&operations), address_(std::move(address)), token_(token) {}

  LockGuard(LockGuard&& other) noexcept
    : operations_(std::exchange(other.operations_, nullptr)), address_(std::move(other.address_)),
      token_(other.token_) {}

  LockGuard& operator=(LockGuard&& other) noexcept {
    std::swap(operations_, other.operations_);
    std::swap(address_, other.address_);
    std::swap(token_, other.token_);
    return *this;
  }

  ~LockGuard();

  const Address& address() const { return address_; }

  /// Higher than the token of any earlier lease of the entry: a resource outside working memory
  /// that is used under the lease (a motor, a file) can refuse requests with a lower token.
  LeaseToken token() const { return token_; }

  /// False once the lease was released or is known to be lost.
  bool held() const;

  /// Releases the lease now. Throws LeaseLostException if it was lost meanwhile.
  void unlock();

private:
  Operations* operations_;
  Address address_;
  LeaseToken token_;
};

} // namespace castor
