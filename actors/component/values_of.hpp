#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"

#include <vector>

namespace castor {

/// Copies of the values of entries, in their order.
template <ReflectedRecord T>
std::vector<T> values_of(const std::vector<EntryOf<T>>& entries) {
  std::vector<T> result;
  result.reserve(entries.size());
  for (const auto& x : entries)
    result.push_back(*x);
  return result;
}

} // namespace castor
