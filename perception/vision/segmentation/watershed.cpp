#include "castor/perception/vision/segmentation/watershed.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace castor::vision {

namespace {

constexpr int levels = 256;
constexpr int unflooded = -1;

/// Calls `visit` with the cells left, right, above and below.
template <class Visit>
void for_neighbours(int cell, int width, int size, Visit visit) {
  const int x = cell % width;
  if (x > 0)
    visit(cell - 1);
  if (x + 1 < width)
    visit(cell + 1);
  if (cell >= width)
    visit(cell - width);
  if (cell + width < size)
    visit(cell + width);
}

} // namespace

Division watershed(const Grid<float>& contrast, float flat, float step) {
  const int width = contrast.width();
  const int size = contrast.size();
  Grid<std::uint8_t> height(width, contrast.height());
  for (int cell = 0; cell < size; ++cell) {
    const float steps = (contrast[cell] - flat) / step;
    height[cell] = static_cast<std::uint8_t>(std::clamp(steps, 0.0F, levels - 1.0F));
  }
  Division result{Grid<int>(width, contrast.height(), unflooded), 0};
  std::array<std::vector<int>, levels> shore;
  // Every plateau without a lower neighbour is the bottom of a basin.
  Grid<std::uint8_t> seen(width, contrast.height(), 0);
  std::vector<int> plateau;
  for (int start = 0; start < size; ++start) {
    if (seen[start] != 0)
      continue;
    seen[start] = 1;
    plateau.assign(1, start);
    bool lowest = true;
    for (std::size_t i = 0; i < plateau.size(); ++i) {
      for_neighbours(plateau[i], width, size, [&](int next) {
        if (height[next] < height[start])
          lowest = false;
        else if (height[next] == height[start] && seen[next] == 0) {
          seen[next] = 1;
          plateau.push_back(next);
        }
      });
    }
    if (!lowest)
      continue;
    for (const int cell : plateau) {
      result.area[cell] = result.count;
      shore[height[start]].push_back(cell);
    }
    ++result.count;
  }
  for (std::size_t level = 0; level < levels; ++level) {
    // The list grows while it is worked off.
    for (std::size_t i = 0; i < shore[level].size(); ++i) {
      const int cell = shore[level][i];
      for_neighbours(cell, width, size, [&](int next) {
        if (result.area[next] != unflooded)
          return;
        result.area[next] = result.area[cell];
        shore[std::max<std::size_t>(level, height[next])].push_back(next);
      });
    }
  }
  return result;
}

} // namespace castor::vision
