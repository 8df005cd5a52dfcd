#pragma once

#include "castor/actors/runtime/version_table.hpp"

#include <cstddef>
#include <optional>
#include <utility>

namespace castor {

/// Which version of which entry a component last read or wrote. Remembers the last `capacity`
/// entries at least and twice as many at most, so that memory stays bounded while entries come and
/// go.
class SeenVersions {
public:
  explicit SeenVersions(std::size_t capacity = 100'000) : capacity_(capacity) {}

  void set(const Address& address, Version version, bool expected = false) {
    young_.set(VersionTable::fingerprint(address), {version, expected});
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
    auto key = VersionTable::fingerprint(address);
    auto x = young_.find(key);
    return x ? x : old_.find(key);
  }

  void erase(const Address& address) {
    auto key = VersionTable::fingerprint(address);
    young_.erase(key);
    old_.erase(key);
  }

private:
  std::size_t capacity_;
  VersionTable young_;
  VersionTable old_;
};

} // namespace castor
