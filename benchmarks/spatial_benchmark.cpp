// What the relations of a scene cost: all five words over all ordered pairs of objects, and the
// search for a position, by how the objects lie. As a yardstick: filling one field of 200 x 200
// cells with the distance from its middle.
#include "castor/perception/spatial/potential_fields.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace castor::spatial {

namespace {

using Clock = std::chrono::steady_clock;

/// Milliseconds for one call, the least of several: whatever disturbs only adds.
template <class F>
double cost(F&& f) {
  auto least = Clock::duration::max();
  for (int run = 0; run < 20; ++run) {
    const auto begin = Clock::now();
    f();
    least = std::min(least, Clock::now() - begin);
  }
  return std::chrono::duration<double, std::milli>(least).count();
}

/// Keeps results from being optimised away.
volatile double sink = 0;

double yardstick() {
  std::vector<double> field(200 * 200);
  return cost([&] {
    for (int x = 0; x < 200; ++x) {
      for (int y = 0; y < 200; ++y)
        field[static_cast<std::size_t>(200 * x + y)] = std::hypot(x - 100, y - 100);
    }
    sink = field[12345];
  });
}

/// Objects within a square with this side, metres.
std::vector<GroundPoint> scatter(std::size_t count, double side) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(-side / 2, side / 2);
  std::vector<GroundPoint> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back({along(random), along(random)});
  return result;
}

void measure(std::size_t count, double side, double unit) {
  const auto objects = scatter(count, side);
  const double pairs = cost([&] {
    const PotentialFields fields(objects, {0, -1});
    double sum = 0;
    for (auto relation : all_spatial_relations) {
      for (std::size_t target = 0; target < count; ++target) {
        for (std::size_t landmark = 0; landmark < count; ++landmark)
          sum += fields.value(relation, target, landmark);
      }
    }
    sink = sum;
  });
  const double search = cost([&] {
    const PotentialFields fields(objects, {0, -1});
    sink = static_cast<double>(fields.positions(SpatialRelation::right, 0, 3).size());
  });
  fmt::print("{:>8} {:>8.2f} {:>12.3f} ({:>5.2f}) {:>12.3f} ({:>5.2f})\n", count, side, pairs,
             pairs / unit, search, search / unit);
}

} // namespace

} // namespace castor::spatial

int main() {
  using namespace castor::spatial;
  const double unit = yardstick();
  fmt::print("ms (and their ratio to those of filling one field, {:.3f} ms)\n", unit);
  fmt::print("{:>8} {:>8} {:>20} {:>20}\n", "objects", "within m", "all relations",
             "three positions");
  for (std::size_t count : {2, 5, 10, 20}) {
    // The nearer objects are to each other, the oftener one covers another's landmark.
    for (double side : {0.2, 0.5, 1.5})
      measure(count, side, unit);
  }
}
