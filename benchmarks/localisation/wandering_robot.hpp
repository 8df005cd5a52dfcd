#pragma once

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <random>

namespace castor::localisation_benchmark {

struct WanderOptions {
  /// Of slip and noise, and of the directions that it turns to.
  std::uint64_t seed = 1;
  /// m/s.
  double speed = 0.5;
  /// It turns where something is nearer ahead, m.
  double turns_before = 0.7;
  /// People who walk to and fro, whose legs the laser sees.
  int people = 0;
};

/// A simulated robot that drives about in a map, straight on until something is in its way, with a
/// laser of 180 degrees. Its odometry begins at zero.
class WanderingRobot {
public:
  WanderingRobot(const mapping::CellMap& map, const mapping::Pose2& start,
                 const WanderOptions& options = {});

  /// A tenth of a second.
  void drive();

  /// What it measured at the end of the last of them.
  const mapping::LaserScan& scan() const { return scan_; }
  mapping::Pose2 odometry() const { return body_.odometry().pose; }
  mapping::Pose2 truth() const { return body_.status().pose; }

  /// Somebody carries it away.
  void kidnap(const mapping::Pose2& to) { body_.carry_to(to); }

private:
  WanderOptions options_;
  mapping::SimulatedBody body_;
  std::mt19937_64 random_;
  mapping::LaserScan scan_;
  /// Direction in which it turns, or 0 if it drives on.
  double turning_ = 0;
};

/// The map with that many boxes of 0.4 m to 0.9 m in free places, which leave room to pass: what
/// has been put into a building since it was mapped.
mapping::CellMap with_boxes(mapping::CellMap map, int boxes, std::uint64_t seed);

/// A place where a robot of that radius has room, uniformly over them. Depends on the seed alone.
mapping::Pose2 random_place(const mapping::CellMap& map, double radius, std::uint64_t seed);

} // namespace castor::localisation_benchmark
