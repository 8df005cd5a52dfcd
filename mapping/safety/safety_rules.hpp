#pragma once

#include "castor/mapping/planar/odometry_history.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/safety/types.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace castor::mapping {

struct SafetyOptions {
  /// Footprint of the robot, a disc; metres.
  double radius = 0.25;
  /// What it keeps away from what the laser sees, beside that; metres.
  double margin = 0.05;
  /// How hard the base brakes at least, m/s^2.
  double braking = 0.6;
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
  /// to the robot, metres.
  std::chrono::microseconds memory{10'000'000};
  double memory_range = 1;
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
/// It is for discs that turn on the spot: turning without driving is always allowed, unless the
/// sensors fail.
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

  explicit SafetyRules(const SafetyOptions& options) : options_(options) {}

  /// A scan that is not newer than the last is ignored.
  /// @param now when it arrived
  void add(const LaserScan& x, std::int64_t now);
  void add(const Odometry& x, std::int64_t now);

  /// Velocity that the robot may have: never faster than commanded, along the same arc, or turning
  /// on the spot where it must not drive on; none if a sensor fails.
  Verdict verdict(const std::optional<Twist2>& commanded, std::int64_t now) const;

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
  };

  SafetyReason failure(std::int64_t now) const;
  /// Whether the laser looks there, from where it is mounted, and so far within its field of view,
  /// radians.
  static bool sees(const LaserScan& scan, double direction, double inset = 0);
  /// Remembers what the laser saw and no longer looks at.
  void remember(const LaserScan& next, const Pose2& pose);
  /// Way until the robot touches something.
  double way(const std::vector<Point2>& points, double curvature, double radius) const;
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
  /// How a robot may turn that is faster than it may be, or drives the other way still: as it is
  /// allowed to when it stands, unless by that it would touch something while it brakes.
  double turn_while_braking(View view, const Twist2& driven, const Twist2& allowed) const;

  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min() / 2;

  SafetyOptions options_;
  struct Remembered {
    /// In the frame of the wheels.
    Point2 point;
    /// When it was seen.
    std::int64_t time = 0;
  };

  std::optional<LaserScan> scan_;
  /// On the robot when it was scanned.
  std::vector<Point2> points_;
  std::vector<Point2> moving_;
  std::vector<Remembered> remembered_;
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
