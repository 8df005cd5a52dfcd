#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace castor {

/// Remembers what was worked out for each entry type. Not for several threads.
template <class T>
class PerType {
public:
  /// What is remembered for the type, otherwise `make()`. The reference lives until the next call.
  template <class F>
  const T& get(const TypeDescriptorPtr& type, F&& make) {
    for (auto& [known, x] : known_)
      if (known == type)
        return x;
    // Types that come anew with every message must not add up.
    if (known_.size() == max_known)
      known_.clear();
    return known_.emplace_back(type, make()).second;
  }

private:
  static constexpr std::size_t max_known = 64;

  std::vector<std::pair<TypeDescriptorPtr, T>> known_;
};

} // namespace castor
