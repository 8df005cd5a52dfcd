#pragma once

#include "castor/mapping/body/laser_model.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping::test {

/// Two rooms of 5 m x 5 m whose wall, at x = 5, has a door in its middle; walls are 0.1 m thick.
inline std::string two_rooms(const std::string& more = {}) {
  return "building test\n"
         "thickness 0.1\n"
         "wall 0 0 to 10 0 to 10 5 to 0 5 close\n"
         "wall 5 0 to 5 5\n"
         "door between at 5 2.5 width 0.9\n"
         "room left at 1 1\n"
         "room right at 9 1\n"
         "start 1 2.5\n" +
         more;
}

/// A laser scanner in a building, and the keyframes that it makes.
class Scanner {
public:
  explicit Scanner(const std::string& building, double noise = 0.01, int field_of_view = 180)
    : Scanner(parse_building(building, "test.building").building, noise, field_of_view) {}

  LaserScan scan(const Pose2& robot, std::vector<Disc> people = {}, std::int64_t time = 0) {
    return laser_.scan(walls_, people, robot, time);
  }

  std::shared_ptr<const LaserScan> shared_scan(const Pose2& robot) {
    return std::make_shared<const LaserScan>(scan(robot));
  }

private:
  Scanner(const Building& building, double noise, int field_of_view)
    : walls_(between_heights(solids_of(building), 0.3, 0.3)),
      laser_({.field_of_view = field_of_view, .range_noise = noise}, 1) {}

  SolidObstacles walls_;
  LaserModel laser_;
};

/// Poses 0.15 m apart along the way, each facing the next.
inline std::vector<Pose2> poses_along(const std::vector<Point2>& way) {
  std::vector<Pose2> result;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const auto length = distance(way[i], way[i + 1]);
    const auto heading = std::atan2(way[i + 1].y - way[i].y, way[i + 1].x - way[i].x);
    const auto steps = static_cast<int>(std::ceil(length / 0.15));
    for (int k = 0; k < steps; ++k)
      result.push_back({std::lerp(way[i].x, way[i + 1].x, k / static_cast<double>(steps)),
                        std::lerp(way[i].y, way[i + 1].y, k / static_cast<double>(steps)),
                        heading});
  }
  return result;
}

} // namespace castor::mapping::test
