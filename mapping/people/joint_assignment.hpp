#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace castor::mapping {

/// One explanation of what is seen of a target: up to two of the parts that were detected.
struct Explanation {
  /// Negative logarithm of its likelihood, beside what all have in common.
  double cost = 0;
  std::array<std::size_t, 2> parts{};
  std::size_t number_of_parts = 0;

  std::span<const std::size_t> all_parts() const { return {parts.data(), number_of_parts}; }
};

/// Explains all targets at once, so that no part belongs to two of them, at the least sum of costs:
/// branch and bound within each group of targets that compete for parts.
/// @param targets explanations of each; one of them without parts
/// @return position of the explanation of each target
std::vector<std::size_t> explain_jointly(const std::vector<std::vector<Explanation>>& targets);

} // namespace castor::mapping
