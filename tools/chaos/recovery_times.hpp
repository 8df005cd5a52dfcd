#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::faults {

/// Recovery times of outages, sorted; without those that had no end.
std::vector<Timestamp> recovery_times(std::span<const Outage> outages);

/// Nearest-rank percentile of sorted times. Nothing if there are none.
std::optional<Timestamp> percentile(std::span<const Timestamp> sorted, int percent);

struct HistogramBin {
  /// From `from` on, and less than `to`.
  Timestamp from{0};
  Timestamp to{0};
  std::size_t count = 0;

  friend bool operator==(const HistogramBin&, const HistogramBin&) = default;
};

/// At most `most_bins` adjacent bins of one width, from 0 on. The width is the smallest possible
/// one of 1, 2 or 5 times a power of ten microseconds.
std::vector<HistogramBin> histogram(std::span<const Timestamp> sorted, std::size_t most_bins);

} // namespace castor::faults
