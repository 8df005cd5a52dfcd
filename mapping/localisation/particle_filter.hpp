#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/localisation/particles.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace castor::mapping {

struct ParticleFilterOptions {
  /// How many particles there are; the number adapts to how many different poses they have (Fox,
  /// "KLD-sampling: adaptive particle filters", 2001).
  unsigned least_particles = 600;
  unsigned most_particles = 40000;
  /// Beams of a scan that are compared with the map: neighbouring beams err together.
  std::size_t beams = 30;
  /// Deviation of a beam's end from the nearest occupied cell, m: noise of the laser, and errors of
  /// the map.
  double hit_deviation = 0.15;
  /// Share of beams that end anywhere, on people and new things.
  double random_beams = 0.1;
  /// Deviations of odometry, as a share of the way and of the turn, with what there is at least,
  /// m and radians.
  double odometry_translation = 0.1;
  double odometry_turn = 0.1;
  double least_translation = 0.01;
  double least_turn = 0.01;
  /// Cells of at least this probability are occupied, percent.
  int occupied_from = 65;
  std::uint64_t seed = 1;
};

/// Particles that follow the robot through a map: MRPT's CMonteCarloLocalization2D with the
/// likelihood field of a laser (Thrun, Burgard, Fox, "Probabilistic robotics", 6.4). Depends on its
/// seed and on what it is given alone, whatever else draws from MRPT's generator.
class ParticleFilter {
public:
  /// @throws std::invalid_argument if no cell of the map is free, or none is occupied, or the map
  /// is turned
  ParticleFilter(const CellMap& map, const ParticleFilterOptions& options);
  ~ParticleFilter();

  /// That many particles over all free cells, in all directions.
  void spread_everywhere(unsigned particles);

  /// Particles around the poses, with these deviations of the position along each axis, m, and of
  /// the heading.
  /// @param poses at least one; as many particles around each
  void spread_around(const std::vector<Pose2>& poses, double deviation, double deviation_heading);

  /// The robot has moved, by its odometry, and sees that now.
  void update(const Pose2& motion, const LaserScan& scan);

  std::vector<Particle> particles() const;

private:
  struct Filter;

  void seed_generator();

  ParticleFilterOptions options_;
  std::uint64_t draws_ = 0;
  std::unique_ptr<Filter> filter_;
};

} // namespace castor::mapping
