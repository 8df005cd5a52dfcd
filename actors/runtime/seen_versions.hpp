#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/entry.hpp"

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

namespace castor {

/// The version of an entry that a component last read or wrote.
struct SeenVersion {
  Version version = 0;
  /// Whether it is the version after writes that were sent and not answered yet, if they succeed.
  bool expected = false;
};

/// Which version of which entry a component last read or wrote. Remembers the last `capacity`
/// entries at least and twice as many at most, so that memory stays bounded while entries come and
/// go.
class SeenVersions {
public:
  explicit SeenVersions(std::size_t capacity = 100'000) : capacity_(capacity) {}

  void set(const Address& address, Version version, bool expected = false) {
    young_[address] = {version, expected};
    if (young_.size() > capacity_) {
      old_ = std::move(young_);
      young_.clear();
    }
  }

  std::optional<Version> get(const Address& address) const {
    auto x = find(address);
    return x ? std::optional{x->version} : std::nullopt;
  }

  std::optional<SeenVersion> find(const Address& address) const {
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
  using Generation = std::unordered_map<Address, SeenVersion>;

  std::size_t capacity_;
  Generation young_;
  Generation old_;
};

} // namespace castor
