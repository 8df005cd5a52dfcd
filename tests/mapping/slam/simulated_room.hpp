#pragma once

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <cstddef>
#include <random>
#include <vector>

namespace castor::mapping::test {

struct Wall {
  Point2 from;
  Point2 to;
};

/// Ten by eight metres with furniture, around a block in the middle: no two places look alike.
std::vector<Wall> furnished_room();

/// Two parallel walls.
std::vector<Wall> endless_corridor();

/// Somebody as a laser sees him, a prism of 0.5 m.
std::vector<Wall> person_at(const Point2& place);

/// What a laser of that many beams, over half a turn or more, sees from there; exactly, without
/// noise.
LaserScan scan_from(const std::vector<Wall>& walls, const Pose2& robot, std::int64_t time = 0,
                    std::size_t beams = 181, double view = 3.141592653589793);

/// The same with deviations of the ranges, m.
LaserScan with_noise(LaserScan scan, double deviation, std::mt19937& random);

/// Poses around the block in the middle of the furnished room, `rounds` times, each 5 cm or 0.05
/// radians from the last.
std::vector<Pose2> path_around(double rounds);

/// What wheels say that slip: steps are 3 % too long, and turns to the left are `drift` radians per
/// metre too large.
std::vector<Pose2> odometry_of(const std::vector<Pose2>& path, double drift);

/// Pose number `i` of the path in a map whose frame began as that of odometry_of().
Pose2 in_map(const std::vector<Pose2>& path, std::size_t i);

} // namespace castor::mapping::test
