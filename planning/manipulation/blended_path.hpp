#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <cstddef>
#include <vector>

namespace castor::manipulation {

/// A path of straight lines whose corners are rounded by parabolas, so that a joint need not stop
/// at them. Its parameter s has the length of the lines; within a parabola positions are quadratic
/// in it.
class BlendedPath {
public:
  /// A piece from begin to end: position = a + b (s - begin) + c (s - begin)^2 for each joint.
  struct Piece {
    double begin = 0;
    double end = 0;
    Configuration a;
    Configuration b;
    Configuration c;
  };

  BlendedPath() = default;

  /// Rounds the corners that permit it.
  /// @param waypoints at least two; equal ones in a row count as one
  /// @param radii for each waypoint, how far from it a parabola begins and ends at most, in the
  /// Euclidean norm; it is at most half as long as the lines beside it. At a corner of radius 0 the
  /// path is not smooth.
  BlendedPath(const std::vector<Configuration>& waypoints, const std::vector<double>& radii);

  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Where the path ends; 0 if it stays at one configuration.
  double length() const { return pieces_.empty() ? 0 : pieces_.back().end; }

  /// Configuration at s, which is taken into [0, length].
  Configuration at(double s) const;

  /// Whether the path is smooth at the beginning of the piece of this index.
  bool is_smooth_before(std::size_t piece) const;

private:
  void add_line(const Configuration& from, const Configuration& to);
  void add_parabola(const Configuration& from, const Configuration& corner,
                    const Configuration& to);

  std::vector<Piece> pieces_;
  Configuration first_;
};

/// The piece's derivative for each joint at s.
Configuration slope(const BlendedPath::Piece& piece, double s);

} // namespace castor::manipulation
