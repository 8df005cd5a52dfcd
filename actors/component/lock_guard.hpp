#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/lease.hpp"

#include <utility>

namespace castor {

class Operations;

/// A lease in hand, given back when the guard goes out of scope.
///
/// The runtime renews the lease while the component is alive and responsive. Should the lease end
/// all the same, writes under it are refused with LeaseLostException, `held()` turns false as soon
/// as this process knows, `unlock()` throws, and the destructor says so in the log.
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

  /// Higher than that of any earlier lease of the entry: whatever outside working memory is used
  /// under the lease (a motor, a file) can refuse who comes with a lower one.
  LeaseToken token() const { return token_; }

  /// False once the lease was given back or is known to be lost.
  bool held() const;

  /// Gives the lease back now. Throws LeaseLostException if it was lost meanwhile.
  void unlock();

private:
  Operations* operations_;
  Address address_;
  LeaseToken token_;
};

} // namespace castor
