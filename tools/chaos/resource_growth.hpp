#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace castor::faults {

/// What a process may gain in the course of a run before that counts as a leak.
struct ResourceTolerance {
  /// While it fills caches and makes connections: not looked at.
  Timestamp warm_up = std::chrono::seconds{5};
  /// Shorter series say nothing.
  std::size_t fewest_samples = 10;
  /// Bytes, and in percent of the least it had; the larger of the two counts.
  double memory = 32e6;
  double memory_percent = 25;
  double files = 8;
  double threads = 4;
};

/// How fast values grow: the median of the slopes between every two of them (Theil and Sen), which
/// a few outliers do not change. In units of `y` per unit of `x`; 0 for fewer than two points.
double robust_slope(std::span<const double> x, std::span<const double> y);

/// One line for each resource of which a process had steadily more and more.
std::vector<std::string> leaks(const ProcessResources& process,
                               const ResourceTolerance& tolerance = {});

} // namespace castor::faults
