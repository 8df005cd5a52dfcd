#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace castor::mapping {

/// Costs of assigning columns to rows; those that are infinite are not assigned.
using CostMatrix = std::vector<std::vector<double>>;

/// The assignment of the most rows, and of these the one with the least sum of costs, by the
/// Hungarian method (Kuhn 1955, Munkres 1957): for each row its column, if any.
/// @param costs rows of equal length, not negative
std::vector<std::optional<std::size_t>> assign(const CostMatrix& costs);

} // namespace castor::mapping
