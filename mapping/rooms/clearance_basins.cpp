#include "castor/mapping/rooms/clearance_basins.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

namespace castor::mapping {

namespace {

/// Cells whose clearances differ by no more, in cells, are flooded together: along a corridor
/// clearances vary by that much on account of the raster.
constexpr float level_height = 0.4F;

constexpr std::int32_t none = -1;

class Flood {
public:
  Flood(const Raster<float>& clearance, double neck_ratio)
    : clearance_(clearance), neck_ratio_(neck_ratio),
      labels_(clearance.columns, clearance.rows, none) {}

  Basins run() {
    std::vector<int> cells;
    for (int i = 0; i < clearance_.size(); ++i)
      if (clearance_[i] > 0)
        cells.push_back(i);
    std::ranges::stable_sort(cells, [&](int a, int b) { return clearance_[a] > clearance_[b]; });
    for (auto first = cells.begin(); first != cells.end();) {
      lowest_ = clearance_[*first] - level_height;
      auto last = std::find_if(first, cells.end(), [&](int x) { return clearance_[x] < lowest_; });
      flood_level(first, last);
      first = last;
    }
    return result();
  }

private:
  using Cells = std::vector<int>::iterator;

  /// The cells of a level, first those that continue basins of higher levels.
  void flood_level(Cells first, Cells last) {
    for (auto i = first; i != last; ++i)
      if (!basins_around(*i).empty())
        pending_.push_back(*i);
    flood_pending();
    for (auto i = first; i != last; ++i) {
      if (labels_[*i] != none)
        continue;
      labels_[*i] = static_cast<std::int32_t>(basins_.size());
      basins_.push_back({*i, clearance_[*i]});
      merged_into_.push_back(labels_[*i]);
      push_around(*i);
      flood_pending();
    }
  }

  void flood_pending() {
    while (!pending_.empty()) {
      auto cell = pending_.front();
      pending_.pop_front();
      if (labels_[cell] != none)
        continue;
      auto around = basins_around(cell);
      labels_[cell] = *std::ranges::max_element(around, {}, [&](auto x) { return peak(x); });
      merge(around, clearance_[cell]);
      push_around(cell);
    }
  }

  void push_around(int cell) {
    for (auto step : clearance_.around())
      if (auto next = cell + step;
          clearance_[next] > 0 && clearance_[next] >= lowest_ && labels_[next] == none)
        pending_.push_back(next);
  }

  /// Merges those of the basins that meet with no neck between them.
  void merge(const std::vector<std::int32_t>& around, float neck) {
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = i + 1; j < around.size(); ++j) {
        auto lesser = root(around[i]);
        auto greater = root(around[j]);
        if (peak(lesser) > peak(greater))
          std::swap(lesser, greater);
        if (lesser != greater && neck >= neck_ratio_ * peak(lesser))
          merged_into_[static_cast<std::size_t>(lesser)] = greater;
      }
  }

  /// In the order of their numbers, each once.
  std::vector<std::int32_t> basins_around(int cell) {
    std::vector<std::int32_t> found;
    for (auto step : clearance_.around())
      if (auto label = labels_[cell + step]; label != none)
        found.push_back(root(label));
    std::ranges::sort(found);
    auto repeated = std::ranges::unique(found);
    found.erase(repeated.begin(), repeated.end());
    return found;
  }

  std::int32_t root(std::int32_t label) {
    auto& next = merged_into_[static_cast<std::size_t>(label)];
    if (next != label)
      next = root(next);
    return next;
  }

  float peak(std::int32_t label) const {
    return basins_[static_cast<std::size_t>(label)].clearance;
  }

  Basins result() {
    Basins result{std::move(labels_), {}};
    std::vector<std::int32_t> numbers(basins_.size(), none);
    for (auto& label : result.labels.cells) {
      if (label == none)
        continue;
      auto old = static_cast<std::size_t>(root(label));
      if (numbers[old] == none) {
        numbers[old] = static_cast<std::int32_t>(result.basins.size());
        result.basins.push_back(basins_[old]);
      }
      label = numbers[old];
    }
    return result;
  }

  const Raster<float>& clearance_;
  double neck_ratio_;
  Raster<std::int32_t> labels_;
  /// Also those that have been merged into others.
  std::vector<Basin> basins_;
  /// The basin itself if it has not been merged.
  std::vector<std::int32_t> merged_into_;
  /// Least clearance of the level that is being flooded.
  float lowest_ = 0;
  std::deque<int> pending_;
};

} // namespace

Basins clearance_basins(const Raster<float>& clearance, double neck_ratio) {
  return Flood(clearance, neck_ratio).run();
}

} // namespace castor::mapping
