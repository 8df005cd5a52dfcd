#pragma once

#include "castor/mapping/graph/segments.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace castor::mapping {

/// Free space around lines, by the scans of keyframes near them.
class ScanClearance {
public:
  /// @param ignored beams that count not, see MovingBeams
  void add(std::int64_t keyframe, const Pose2& robot, const LaserScan& scan,
           const std::vector<bool>& ignored);
  void remove(std::int64_t keyframe);
  /// The pose of the keyframe was corrected.
  void move(std::int64_t keyframe, const Pose2& robot);

  /// Distance from the line to the nearest thing that keyframes near it have seen, at most `limit`;
  /// metres. Single points are taken for noise.
  double clearance(const Line2& line, double limit) const;

private:
  struct Seen {
    Pose2 robot;
    /// Ends of beams on the robot.
    std::vector<Point2> points;
  };

  /// A square metre of the map.
  using Square = std::pair<std::int64_t, std::int64_t>;

  static Square square_of(const Point2& x);
  std::vector<const Seen*> seen_near(const Line2& line) const;

  std::map<std::int64_t, Seen> seen_;
  /// Keyframes by the place of the robot.
  std::map<Square, std::set<std::int64_t>> squares_;
};

} // namespace castor::mapping
