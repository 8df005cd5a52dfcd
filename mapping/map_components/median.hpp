#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace castor::mapping {

/// The upper one of the two in the middle of an even number. There has to be one.
inline double median_of(std::vector<double> values) {
  auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace castor::mapping
