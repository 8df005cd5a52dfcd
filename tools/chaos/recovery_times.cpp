#include "castor/tools/chaos/recovery_times.hpp"

#include <algorithm>

namespace castor::faults {

namespace {

Timestamp round_width(Timestamp at_least) {
  for (Timestamp power{1};; power *= 10)
    for (auto factor : {1, 2, 5})
      if (power * factor >= at_least)
        return power * factor;
}

} // namespace

std::vector<Timestamp> recovery_times(std::span<const Outage> outages) {
  std::vector<Timestamp> result;
  for (auto& x : outages)
    if (auto time = x.recovery())
      result.push_back(*time);
  std::ranges::sort(result);
  return result;
}

std::optional<Timestamp> percentile(std::span<const Timestamp> sorted, int percent) {
  if (sorted.empty())
    return std::nullopt;
  auto rank = (sorted.size() * static_cast<std::size_t>(percent) + 99) / 100;
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

std::vector<HistogramBin> histogram(std::span<const Timestamp> sorted, std::size_t most_bins) {
  if (sorted.empty())
    return {};
  // The largest is still to be less than the end of the last bin.
  auto width = round_width(sorted.back() / static_cast<std::int64_t>(most_bins) + Timestamp{1});
  std::vector<HistogramBin> result(static_cast<std::size_t>(sorted.back() / width) + 1);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].from = width * static_cast<std::int64_t>(i);
    result[i].to = result[i].from + width;
  }
  for (auto x : sorted)
    ++result[static_cast<std::size_t>(x / width)].count;
  return result;
}

} // namespace castor::faults
