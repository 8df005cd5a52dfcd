#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace castor {

/// Cache of a value per entry type. Not thread-safe.
template <class T>
class PerType {
public:
  /// The cached value of the type, or the new `make()`. The reference is valid until the next call.
  template <class F>
  const T& get(const TypeDescriptorPtr& type, F&& make) {
    for (auto& [known, x] : known_)
      if (known == type)
        return x;
    // Bounds the memory if every message brings a new type.
    if (known_.size() == max_known)
      known_.clear();
    return known_.emplace_back(type, make()).second;
  }

private:
  static constexpr std::size_t max_known = 64;

  std::vector<std::pair<TypeDescriptorPtr, T>> known_;
};

} // namespace castor
