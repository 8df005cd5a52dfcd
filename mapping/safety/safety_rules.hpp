#pragma once

#include "castor/mapping/body/footprint.hpp"
#include "castor/mapping/planar/odometry_history.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/safety/types.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace castor::mapping {

struct SafetyOptions {
  /// Footprint of the robot, a disc; metres.
  double radius = 0.25;
  /// In place of the disc.
  std::optional<Footprint> footprint = {};
  /// Of the smallest circle that it drives, as a car does, metres; 0: it turns on the spot.
  double turning_radius = 0;
  /// What it keeps away from what the laser sees, beside that; metres.
  double margin = 0.05;
  /// How hard the base brakes at least, m/s^2.
  double braking = 0.6;
  /// The same for its turning, rad/s^2; counts for what is no disc.
  double turn_braking = 1.5;
  /// From the moment that something can be seen until the base brakes, seconds: the time between
  /// two scans, and that of the messages.
  double latency = 0.15;
  /// Speed within the margin, m/s, so that the robot can leave narrow places.
  double creeping = 0.05;
  /// What it keeps away from what has moved to where it is, beside the margin: that may come from
  /// the side; metres.
  double moving_margin = 0.15;
  /// Greatest speed to where the laser does not see, m/s.
  double unseen = 0.1;
  /// What a laser that does not look all around has seen stays known for that long, and that near
  /// to the robot's edge, metres.
  std::chrono::microseconds memory{10'000'000};
  double memory_range = 0.75;
  /// What did not move stays known for longer to what has corners: it turns slowly, into where it
  /// looked before.
  std::chrono::microseconds standing_memory{60'000'000};
  /// A laser or wheels that say nothing for longer are silent. Of a laser with 10 Hz, one scan may
  /// be lost.
  std::chrono::microseconds laser_patience{230'000};
  std::chrono::microseconds odometry_patience{200'000};
  /// Whether no two scans of a laser that works are the same. If not, they may be as long as the
  /// robot stands.
  bool laser_has_noise = true;
};

/// Decides how fast a robot may drive, from what its laser and its wheels say. Without clocks:
/// times are microseconds since the system began, as in scans.
///
/// A disc may always turn on the spot, unless the sensors fail; what has corners only as far as they
/// touch nothing, and as slowly as that permits.
class SafetyRules {
public:
  struct Verdict {
    Twist2 velocity;
    SafetyReason reason = SafetyReason::none;
    /// Until the robot touches what the laser sees, if it drives as commanded; metres, at most the
    /// laser's range.
    double free_way = 0;

    friend bool operator==(const Verdict&, const Verdict&) = default;
  };

  explicit SafetyRules(const SafetyOptions& options);

  /// A scan that is not newer than the last is ignored.
  /// @param now when it arrived
  void add(const LaserScan& x, std::int64_t now);
  void add(const Odometry& x, std::int64_t now);

  /// Velocity that the robot may have: never faster than commanded, along the same arc, or turning
  /// on the spot where it must not drive on; none if a sensor fails.
  Verdict verdict(const std::optional<Twist2>& command, std::int64_t now) const;

private:
  struct Seen {
    LaserScan scan;
    std::vector<Point2> points;
    Pose2 wheels;
  };

  /// What is seen around the robot now, and what was seen before, as from where it is now.
  struct View {
    std::vector<Point2> points;
    /// Those of `points` that have moved to where they are.
    std::vector<Point2> moving;
    std::vector<Point2> before;
    /// -1: of a robot in a mirror, which drives forwards where the robot drives backwards.
    double side = 1;
  };

  SafetyReason failure(std::int64_t now) const;
  /// As the base can obey: a car drives no smaller circle than it can.
  Twist2 drivable(Twist2 x) const;
  /// Whether the laser looks there, from where it is mounted, and so far within its field of view,
  /// radians.
  static bool sees(const LaserScan& scan, double direction, double inset = 0);
  /// Remembers what the laser saw and no longer looks at.
  void remember(const LaserScan& next, const Pose2& pose);
  static View mirrored(View x);
  /// Way until the robot is as near to something as the gap; `side` is that of the view.
  double way(const std::vector<Point2>& points, double curvature, double gap, double side) const;
  /// How far it may turn on the spot until then, radians.
  double turn(const View& view, bool is_left, double gap, double gap_of_moving) const;
  /// Pose of the wheels now.
  Pose2 wheels_now(std::int64_t now) const;
  /// What the newest scan shows where the laser has looked through a few scans before, on the robot
  /// when it was scanned.
  std::vector<Point2> moved_points() const;
  View view_now(const Pose2& wheels) const;
  /// How fast something comes towards the robot along the arc, m/s, beside the robot's own motion;
  /// 0 if that cannot be told from noise.
  double approach(const View& view, double curvature) const;
  /// Greatest speed along the arc.
  double speed_along(const View& view, double curvature) const;
  /// Greatest rate at which it may turn on the spot, rad/s.
  double turn_speed(const View& view, bool is_left) const;
  /// Share of a velocity with which no point of the outline that the laser does not see comes
  /// outwards faster than what is permitted unseen.
  double unseen_share(const Twist2& velocity) const;
  /// What has corners, as slow as it has to be where the laser does not look, and where it turns.
  Verdict with_corners(Verdict x, const View& view) const;
  /// How a robot may turn that is faster than it may be, or drives the other way still: as it is
  /// allowed to when it stands, unless by that it would touch something while it brakes.
  double turn_while_braking(View view, const Twist2& driven, const Twist2& allowed) const;

  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min() / 2;

  SafetyOptions options_;
  /// Of the footprint, anticlockwise, and in the mirror; empty for a disc.
  Polygon outline_;
  Polygon mirrored_outline_;
  struct Remembered {
    /// In the frame of the wheels.
    Point2 point;
    /// Until when it stays known.
    std::int64_t until = 0;
  };

  std::optional<LaserScan> scan_;
  /// On the robot when it was scanned.
  std::vector<Point2> points_;
  std::vector<Point2> moving_;
  /// By cells of the frame of the wheels, one for each.
  std::map<std::pair<long, long>, Remembered> remembered_;
  /// The last scans, oldest first, to see what moves.
  std::deque<Seen> earlier_;
  /// Pose of the wheels at the newest scan.
  Pose2 scanned_at_;
  /// Time of the newest scan, and of the newest that shows that the laser works.
  std::int64_t scan_time_ = never;
  std::int64_t fresh_ = never;
  /// Pose of the wheels at the newest scan that differs from the one before.
  Pose2 differed_at_;
  OdometryHistory odometry_;
  std::int64_t odometry_time_ = never;
};

} // namespace castor::mapping
