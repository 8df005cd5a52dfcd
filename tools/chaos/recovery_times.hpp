#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::faults {

/// How long outages took, in order; without those that had no end.
std::vector<Timestamp> recovery_times(std::span<const Outage> outages);

/// The smallest of the times, which are in order, that so many percent of them do not exceed
/// (nearest rank). Nothing if there are none.
std::optional<Timestamp> percentile(std::span<const Timestamp> sorted, int percent);

struct HistogramBin {
  /// From `from` on, and less than `to`.
  Timestamp from{0};
  Timestamp to{0};
  std::size_t count = 0;

  friend bool operator==(const HistogramBin&, const HistogramBin&) = default;
};

/// Bins of one width, from 0 on, without a gap: at most so many, and as narrow as a width of 1, 2
/// or 5 times a power of ten microseconds allows.
std::vector<HistogramBin> histogram(std::span<const Timestamp> sorted, std::size_t most_bins);

} // namespace castor::faults
