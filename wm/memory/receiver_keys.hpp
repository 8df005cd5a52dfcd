#pragma once

#include "castor/wm/events/change_notice.hpp"
#include "castor/wm/filters/filter_index.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// Keys of the filter indices: the number of a subscriber or peer in the upper 32 bits, that of its
/// filter or interest in the lower.
namespace castor::receiver_keys {

inline FilterIndex::Key key_of(std::uint32_t receiver, std::uint32_t id) {
  return static_cast<FilterIndex::Key>(receiver) << 32 | id;
}

inline void sort_unique(std::vector<FilterIndex::Key>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// Calls `f` with each subscriber or peer and its filters or interests. \pre the keys are sorted
template <class F>
void for_each_receiver(const std::vector<FilterIndex::Key>& keys, F&& f) {
  for (std::size_t i = 0; i < keys.size();) {
    auto receiver = static_cast<std::uint32_t>(keys[i] >> 32);
    FilterIds ids;
    for (; i < keys.size() && keys[i] >> 32 == receiver; ++i)
      ids.push_back(static_cast<std::uint32_t>(keys[i]));
    f(receiver, std::move(ids));
  }
}

} // namespace castor::receiver_keys
