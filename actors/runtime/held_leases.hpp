#pragma once

#include "castor/actors/runtime/rest.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/lease.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// The leases that a component holds, as far as its process knows: the component uses them, the
/// keeper renews them. Safe to use from any thread.
class HeldLeases {
public:
  /// `rest`, that of the keeper, ends when there is a lease.
  void set_rest(std::shared_ptr<Rest> rest) {
    std::lock_guard guard{mutex_};
    rest_ = std::move(rest);
  }

  bool empty() const { return count_ == 0; }

  /// A lease was obtained, for the first time or repeatedly.
  void add(const Address& address, LeaseToken token) {
    std::lock_guard guard{mutex_};
    auto& x = leases_[address];
    if (x.token != token)
      x = {token, 0, false};
    ++x.times;
    count_ = leases_.size();
    if (rest_)
      rest_->end();
  }

  /// Undoes one lock of that lease; false if the entry is gone, and its lease with it.
  bool release(const Address& address, LeaseToken token) {
    std::lock_guard guard{mutex_};
    auto i = leases_.find(address);
    if (i == leases_.end())
      return false;
    // The token may be that of an earlier lease of the entry.
    if (i->second.token == token && --i->second.times == 0)
      leases_.erase(i);
    count_ = leases_.size();
    return true;
  }

  /// The entry is gone, and its lease with it.
  void forget(const Address& address) {
    if (count_ == 0)
      return;
    std::lock_guard guard{mutex_};
    leases_.erase(address);
    count_ = leases_.size();
  }

  struct Held {
    LeaseToken token = 0;
    /// Number of locks that were not undone.
    std::size_t times = 0;
    bool lost = false;
  };

  std::optional<Held> find(const Address& address) const {
    if (count_ == 0)
      return std::nullopt;
    std::lock_guard guard{mutex_};
    auto i = leases_.find(address);
    return i == leases_.end() ? std::nullopt : std::optional{i->second};
  }

  /// The token for writes; also of a lost lease, so that the write is refused. 0 for none.
  LeaseToken token(const Address& address) const {
    auto x = find(address);
    return x ? x->token : 0;
  }

  void mark_lost(const Address& address, LeaseToken token) {
    std::lock_guard guard{mutex_};
    auto i = leases_.find(address);
    if (i != leases_.end() && i->second.token == token)
      i->second.lost = true;
  }

  /// Those not known to be lost, by subarchitecture.
  std::map<std::string, std::vector<std::pair<std::string, LeaseToken>>> to_renew() const {
    std::map<std::string, std::vector<std::pair<std::string, LeaseToken>>> result;
    if (count_ == 0)
      return result;
    std::lock_guard guard{mutex_};
    for (auto& [address, x] : leases_)
      if (!x.lost)
        result[address.subarchitecture].emplace_back(address.id, x.token);
    return result;
  }

private:
  mutable std::mutex mutex_;
  std::shared_ptr<Rest> rest_;
  std::map<Address, Held> leases_;
  /// Size of `leases_`, so that components without leases need no lock.
  std::atomic<std::size_t> count_{0};
};

} // namespace castor
