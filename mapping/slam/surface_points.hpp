#pragma once

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <vector>

namespace castor::mapping {

/// A point of a wall or a thing that a laser beam ended at.
struct SurfacePoint {
  Point2 position;
  /// Of length one, towards the laser; zero where the surface is not known.
  Point2 normal;

  bool has_normal() const { return normal.x != 0 || normal.y != 0; }
};

using SurfacePoints = std::vector<SurfacePoint>;

struct SurfaceOptions {
  /// Beams that end further away are left out, m.
  double max_range = 30;
  /// And nearer ones, which are of the robot itself.
  double min_range = 0.05;
  /// Ends of neighbouring beams are of one surface up to this distance, m ...
  double same_surface = 0.15;
  /// ... or up to this share of their range, if that is more.
  double same_surface_share = 0.06;
  /// Points within this distance say which way a surface faces, m; further ones where the beams
  /// are far apart.
  double fit_radius = 0.15;
  /// They are on a line up to this deviation, m.
  double line_deviation = 0.03;
};

/// The ends of a scan's beams on the robot, in the order of the beams, with the directions that the
/// surfaces face: normals of lines through neighbouring ends (total least squares).
SurfacePoints surface_points(const LaserScan& scan, const SurfaceOptions& options = {});

/// The same points in the frame of the body's pose.
SurfacePoints transform(const Pose2& body, const SurfacePoints& points);

/// Some of the points, at least `spacing` m from each other or in different cells of that size.
SurfacePoints thinned(const SurfacePoints& points, double spacing);

} // namespace castor::mapping
