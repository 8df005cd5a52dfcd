#pragma once

#include "castor/mapping/planar/types.hpp"
#include "castor/mapping/slam/types.hpp"

#include <vector>

namespace castor::mapping {

/// A place where the robot may be.
struct Particle {
  Pose2 pose;
  /// Probability; those of all particles add up to 1.
  double weight = 0;
};

struct ClusterOptions {
  /// Particles in neighbouring cells of this size, m and radians, belong together.
  double cell = 0.5;
  double cell_heading = 0.5;
};

/// Particles that are near each other.
struct ParticleCluster {
  /// Probability that the robot is in it.
  double weight = 0;
  Pose2 mean;
  PoseCovariance covariance;

  /// Deviation of the position from the mean, m.
  double spread() const;
};

/// All clusters of the particles, the most probable one first. Headings that differ by a whole turn
/// are the same.
std::vector<ParticleCluster> clusters_of(const std::vector<Particle>& particles,
                                         const ClusterOptions& options = {});

} // namespace castor::mapping
