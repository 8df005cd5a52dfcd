#include "castor/benchmarks/rooms/other_methods.hpp"

#include "castor/mapping/rooms/clearance.hpp"
#include "castor/mapping/rooms/clearance_basins.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

namespace castor::mapping {

namespace {

using Part = std::vector<int>;

/// Parts of the cells with more clearance than `level`, cells beside each other.
std::vector<Part> parts_above(const Raster<float>& clearance, double level) {
  std::vector<Part> result;
  Raster<char> visited(clearance.columns, clearance.rows, 0);
  auto visit = [&](int cell, Part& part) {
    if (clearance[cell] > level && std::exchange(visited[cell], 1) == 0)
      part.push_back(cell);
  };
  for (int i = 0; i < clearance.size(); ++i) {
    Part part;
    visit(i, part);
    for (std::size_t k = 0; k < part.size(); ++k)
      for (auto step : clearance.beside())
        visit(part[k] + step, part);
    if (!part.empty())
      result.push_back(std::move(part));
  }
  return result;
}

/// Gives free cells the number of the labelled cell that is nearest by way.
std::vector<std::int32_t> spread(Raster<std::int32_t> labels, const Raster<float>& clearance) {
  std::deque<int> pending;
  for (int i = 0; i < labels.size(); ++i)
    if (labels[i] != 0)
      pending.push_back(i);
  while (!pending.empty()) {
    auto cell = pending.front();
    pending.pop_front();
    for (auto step : labels.beside())
      if (auto next = cell + step; clearance[next] > 0 && labels[next] == 0) {
        labels[next] = labels[cell];
        pending.push_back(next);
      }
  }
  std::vector<std::int32_t> result;
  for (int row = 0; row < labels.rows; ++row)
    for (int column = 0; column < labels.columns; ++column)
      result.push_back(labels[labels.position(column, row)]);
  return result;
}

double greatest(const Raster<float>& clearance) {
  return std::ranges::max(clearance.cells);
}

} // namespace

std::vector<std::int32_t> rooms_by_erosion(const CellMap& map, const RoomOptions& options,
                                           const RoomAreas& areas) {
  const auto clear = clearance(map, options.largest_furniture, options.free_to);
  const auto cell_area = map.cell_size * map.cell_size;
  Raster<std::int32_t> labels(map.columns, map.rows, 0);
  std::int32_t last = 0;
  for (int level = 0; level < greatest(clear); ++level)
    for (const auto& part : parts_above(clear, level)) {
      auto area = static_cast<double>(part.size()) * cell_area;
      if (area < areas.smallest || area > areas.largest || labels[part.front()] != 0)
        continue;
      ++last;
      for (auto cell : part)
        labels[cell] = last;
    }
  return spread(std::move(labels), clear);
}

std::vector<std::int32_t> rooms_by_threshold(const CellMap& map, const RoomOptions& options,
                                             const RoomAreas& areas) {
  const auto clear = clearance(map, options.largest_furniture, options.free_to);
  const auto cell_area = map.cell_size * map.cell_size;
  std::vector<Part> best;
  for (int level = 0; level < greatest(clear); ++level) {
    auto parts = parts_above(clear, level);
    std::erase_if(parts, [&](const Part& x) {
      return static_cast<double>(x.size()) * cell_area < areas.smallest;
    });
    if (parts.size() > best.size())
      best = std::move(parts);
  }
  Raster<std::int32_t> labels(map.columns, map.rows, 0);
  for (std::size_t i = 0; i < best.size(); ++i)
    for (auto cell : best[i])
      labels[cell] = static_cast<std::int32_t>(i) + 1;
  return spread(std::move(labels), clear);
}

std::vector<std::int32_t> rooms_by_watershed(const CellMap& map, const RoomOptions& options) {
  const auto clear = clearance(map, options.largest_furniture, options.free_to);
  auto labels = clearance_basins(clear, options.neck_ratio).labels;
  for (auto& x : labels.cells)
    ++x; // from -1 for none
  return spread(std::move(labels), clear);
}

} // namespace castor::mapping
