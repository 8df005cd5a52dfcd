#pragma once

#include "castor/mapping/localisation/distance_field.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <vector>

namespace castor::mapping {

struct MapAlignmentOptions {
  int iterations = 15;
  /// Deviation of a beam's end from the nearest occupied cell, m; ends that are further away count
  /// less (the loss of Geman and McClure), and those beyond `furthest` do not.
  double deviation = 0.1;
  double furthest = 0.6;
  /// It begins with this deviation, m, and is multiplied by `narrowing` in each iteration: so ends
  /// that are far away count in the beginning.
  double first_deviation = 0.5;
  double narrowing = 0.7;
  /// Deviations of the guess, m and radians.
  double prior = 0.2;
  double prior_heading = 0.1;
};

/// Ends of the scan's beams on the robot: of those that came back, evenly over the scan, about as
/// many.
std::vector<Point2> ends_of_beams(const LaserScan& scan, std::size_t beams);

/// The pose near the guess at which the points lie nearest to occupied cells: Gauss and Newton's
/// method on the distances (Kohlbrecher et al., "A flexible and scalable SLAM system with full 3D
/// motion estimation", 2011, with distances in place of probabilities).
/// @param points on the robot
Pose2 aligned(const DistanceField& map, const std::vector<Point2>& points, const Pose2& guess,
              const MapAlignmentOptions& options = {});

} // namespace castor::mapping
