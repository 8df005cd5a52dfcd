#pragma once

#include "castor/wm/address.hpp"
#include "castor/wm/entry.hpp"

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

namespace castor {

/// Which version of which entry a component last read or wrote. Remembers the last `capacity`
/// entries at least and twice as many at most, so that a component that sees entries come and go
/// all day does not grow.
class SeenVersions {
public:
  explicit SeenVersions(std::size_t capacity = 100'000) : capacity_(capacity) {}

  void set(const Address& address, Version version) {
    young_[address] = version;
    if (young_.size() > capacity_) {
      old_ = std::move(young_);
      young_.clear();
    }
  }

  std::optional<Version> get(const Address& address) const {
    for (auto* generation : {&young_, &old_})
      if (auto i = generation->find(address); i != generation->end())
        return i->second;
    return std::nullopt;
  }

  void erase(const Address& address) {
    young_.erase(address);
    old_.erase(address);
  }

private:
  using Generation = std::unordered_map<Address, Version>;

  std::size_t capacity_;
  Generation young_;
  Generation old_;
};

} // namespace castor
