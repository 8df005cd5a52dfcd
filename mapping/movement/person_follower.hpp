#pragma once

#include "castor/mapping/movement/clearance_map.hpp"
#include "castor/mapping/movement/followed_person.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>

namespace castor::mapping {

struct FollowPersonOptions {
  /// Way to keep between the middles of robot and person, and the least of it; metres.
  double distance = 1.2;
  double nearest = 0.8;
  /// m/s and rad/s.
  double speed = 0.8;
  double max_turn = 1.2;
  /// How hard it gains speed, and how hard it counts on braking; m/s^2.
  double acceleration = 0.6;
  double braking = 0.5;
  /// Time until a command has an effect, seconds.
  double reaction = 0.2;
  /// How fast it makes up for a distance that is too large, 1/s.
  double gain = 1;
  /// How far ahead on the trail it aims, metres.
  double look_ahead = 0.5;
  /// Of the footprint; what it keeps from obstacles on shortcuts, and from what the laser sees;
  /// metres.
  double radius = 0.25;
  double margin = 0.06;
  double gap = 0.03;
  /// It goes on so far beyond where the person was seen last, in the direction of walking, metres.
  double beyond = 0.8;
  /// Times in microseconds. It gives up when the person has been out of sight for so long, or
  /// something has been in the way.
  std::int64_t patience = 15'000'000;
  FollowedPersonOptions person;
};

/// Drives a robot behind a person: along the way that the person walked, or straight where that is
/// free, at a distance. It stands when it is near, and faces the person. Of a person out of sight,
/// as behind a corner, it goes on to where the person was last, and looks around there; it gives up
/// with a reason.
///
/// Its only time is that of its arguments. Everything is in the map frame.
class PersonFollower {
public:
  PersonFollower(std::int64_t person, const FollowPersonOptions& options)
    : options_(options), person_(person, options.person) {}

  struct Step {
    Twist2 velocity;
    /// moving, waiting (behind somebody who stands, or before something), recovering (it looks for
    /// the person), or failed, which is the end.
    MovementStatus status = MovementStatus::moving;
    std::string waits_for;
    std::string reason;
  };

  /// @param time microseconds
  /// @param people whom a tracker sees now
  /// @param map clearance from what is on the map; without columns if there is none
  /// @param seen what the laser has seen lately
  Step step(std::int64_t time, const Pose2& robot, std::span<const SeenPerson> people,
            const ClearanceMap& map, std::span<const Point2> seen);

  /// Whom it follows now: a person who was lost for a while may have got another id.
  std::int64_t person() const { return person_.id(); }
  /// Way from the robot to the person, metres; 0 before the first sight.
  double way() const { return way_; }

private:
  void note(const SeenPerson& x);
  void pass_trail(const Pose2& robot);
  Step follow(const Pose2& robot, const ClearanceMap& map, std::span<const Point2> seen);
  Step search(const Pose2& robot, const ClearanceMap& map, std::span<const Point2> seen);
  /// The farthest point of the trail that is straight ahead of the robot without an obstacle, and
  /// not nearer than the look-ahead.
  std::size_t aim(const Pose2& robot, const ClearanceMap& map, std::span<const Point2> seen) const;
  bool is_free(const Point2& a, const Point2& b, const ClearanceMap& map,
               std::span<const Point2> seen) const;
  Point2 carrot(const Pose2& robot, std::size_t aimed) const;
  Step drive_to(const Pose2& robot, const Point2& goal, double speed, std::span<const Point2> seen);
  double way_along(const Pose2& robot, std::size_t from) const;
  Step turn_to(double aside, MovementStatus status, const std::string& waits_for);
  Step fail(const std::string& reason);

  FollowPersonOptions options_;
  FollowedPerson person_;
  /// Where the person walked, from about where the robot is; the last is the newest place.
  std::deque<Point2> trail_;
  std::optional<SeenPerson> last_;
  std::int64_t time_ = 0;
  std::int64_t begun_ = -1;
  std::int64_t seen_time_ = 0;
  double dt_ = 0;
  double speed_ = 0;
  double way_ = 0;
  bool is_turning_ = false;
  bool has_looked_beyond_ = false;
  std::optional<std::int64_t> blocked_since_;
};

} // namespace castor::mapping
