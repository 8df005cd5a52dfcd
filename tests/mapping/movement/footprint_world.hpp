#pragma once

#include "castor/mapping/body/footprint.hpp"
#include "castor/mapping/building/grid_obstacles.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/movement/pose_path.hpp"
#include "castor/tests/mapping/movement/drawn_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

/// Robots whose footprint is no disc, and rooms for them.
namespace castor::mapping::test {

/// 1.2 m long, 0.5 m wide; its middle is where its wheels are.
inline Footprint long_robot() {
  return Footprint{{{0.6, 0.25}, {-0.6, 0.25}, {-0.6, -0.25}, {0.6, -0.25}}};
}

/// 0.7 m long, 0.44 m wide, and its wheels that do not steer are behind.
inline Footprint car() {
  return Footprint{{{0.55, 0.22}, {-0.15, 0.22}, {-0.15, -0.22}, {0.55, -0.22}}};
}

/// Two rooms of 3 by 4 metres with a door between them.
inline CellMap two_rooms(double door_width) {
  auto map = empty_room(6, 4);
  fill(map, 2.95, 0, 3.05, 4);
  fill(map, 2.95, 2 - door_width / 2, 3.05, 2 + door_width / 2, 0);
  return map;
}

inline std::unique_ptr<Obstacles> obstacles_of(const CellMap& map) {
  std::vector<std::uint8_t> cells;
  for (auto x : map.cells)
    cells.push_back(x >= 60 ? 1 : 0);
  return std::make_unique<GridObstacles>(std::move(cells), map.columns, map.rows, map.cell_size,
                                         Point2{map.origin.x, map.origin.y});
}

/// Gap between a convex polygon and a square, by the axis that separates them most; negative if
/// there is none. At corners it is at most the distance.
inline double gap(const Polygon& polygon, const Polygon& square) {
  double most = -std::numeric_limits<double>::infinity();
  for (const auto* sides : {&polygon, &square})
    for (std::size_t i = 0; i < sides->size(); ++i) {
      const auto& a = (*sides)[i];
      const auto& b = (*sides)[(i + 1) % sides->size()];
      const double size = std::hypot(b.x - a.x, b.y - a.y);
      const Point2 axis{(b.y - a.y) / size, (a.x - b.x) / size};
      const auto reach = [&](const Polygon& x) {
        std::pair<double, double> result{std::numeric_limits<double>::infinity(),
                                         -std::numeric_limits<double>::infinity()};
        for (const auto& p : x) {
          const double at = p.x * axis.x + p.y * axis.y;
          result = {std::min(result.first, at), std::max(result.second, at)};
        }
        return result;
      };
      const auto one = reach(polygon);
      const auto other = reach(square);
      most = std::max({most, one.first - other.second, other.first - one.second});
    }
  return most;
}

/// Least gap between a convex footprint and the occupied cells along a path, each half centimetre;
/// it shares nothing with the planner.
inline double least_gap(const CellMap& map, const Footprint& footprint, const PosePath& path) {
  double result = std::numeric_limits<double>::infinity();
  auto begin = path.start;
  for (const auto& motion : path.motions) {
    const double way = std::abs(motion.forward) + footprint.outer_radius() * std::abs(motion.turn);
    const int pieces = static_cast<int>(std::ceil(way / 0.005)) + 1;
    for (int i = 0; i <= pieces; ++i) {
      const auto pose = moved(begin, motion, static_cast<double>(i) / pieces);
      Polygon outline;
      for (const auto& x : footprint.outline())
        outline.push_back(transform(pose, x));
      const int reach =
        static_cast<int>(std::ceil((footprint.outer_radius() + 0.1) / map.cell_size));
      const int column = static_cast<int>(std::floor(pose.x / map.cell_size));
      const int row = static_cast<int>(std::floor(pose.y / map.cell_size));
      for (int r = std::max(0, row - reach); r <= std::min(map.rows - 1, row + reach); ++r)
        for (int c = std::max(0, column - reach); c <= std::min(map.columns - 1, column + reach);
             ++c) {
          if (map.at(c, r) < 60)
            continue;
          const double x = c * map.cell_size;
          const double y = r * map.cell_size;
          const double size = map.cell_size;
          result = std::min(
            result, gap(outline, {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}));
        }
    }
    begin = moved(begin, motion, 1);
  }
  return result;
}

} // namespace castor::mapping::test
