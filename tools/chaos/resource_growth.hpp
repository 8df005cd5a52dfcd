#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace castor::faults {

/// Growth of a process's resources in a run that does not count as a leak.
struct ResourceTolerance {
  /// Ignored time at the beginning, while the process fills caches and makes connections.
  Timestamp warm_up = std::chrono::seconds{5};
  /// Shorter series are not judged.
  std::size_t fewest_samples = 10;
  /// Bytes, and percent of the minimum; the larger of the two limits applies.
  double memory = 32e6;
  double memory_percent = 25;
  double files = 8;
  double threads = 4;
};

/// Slope of a robust linear fit: the median of the slopes between every two points (Theil and Sen).
/// In units of `y` per unit of `x`; 0 for fewer than two points.
double robust_slope(std::span<const double> x, std::span<const double> y);

/// One line for each resource of a process that grew steadily beyond the tolerance.
std::vector<std::string> leaks(const ProcessResources& process,
                               const ResourceTolerance& tolerance = {});

} // namespace castor::faults
