#pragma once

#include "castor/mapping/movement/followed_person.hpp"
#include "castor/mapping/movement/goal_pursuit.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::mapping {

struct FollowPersonOptions {
  /// Way to keep between the middles of robot and person, and the least distance; metres.
  double distance = 1.2;
  double nearest = 0.8;
  /// At most, m/s.
  double speed = 1;
  /// The same where there is little room, as in doors that the person has just walked through.
  double narrow_speed = 0.5;
  /// How fast it makes up for a distance that is too large, 1/s.
  double gain = 1;
  /// It looks so far beyond where the person was seen last, in the direction of walking, metres.
  double beyond = 0.8;
  /// It gives up when the person has been out of sight for so long, or cannot be reached for so
  /// long; microseconds.
  std::int64_t patience = 15'000'000;
  FollowedPersonOptions person;
  /// How it passes those who walk, and what it keeps at least from what the map does not have, and
  /// plans keep besides, metres: bodies may be so much wider than the legs that the laser sees.
  PassingOptions passing;
  double unexpected_gap = 0.18;
  double unexpected_margin = 0.13;
  /// How it goes there. Its speed is the one above.
  PursuitOptions pursuit;
};

/// How a robot goes to the places of a person's way.
PursuitOptions pursuit_behind_person(const FollowPersonOptions& options);

/// Leads a robot behind a person: chooses the place to go to, which a GoalPursuit does, and the
/// speed that keeps the distance. Near the person it stands, and faces the person. Of a person out
/// of sight, as behind a corner, it goes on to where the person was last, and looks around there;
/// it gives up with a reason.
///
/// Its only time is that of its arguments. Everything is in the map frame.
class PersonFollower {
public:
  PersonFollower(std::int64_t person, const FollowPersonOptions& options);

  /// Its status is moving, waiting (behind somebody who stands, or before something), recovering
  /// (from a stall, or it looks for the person), or failed, which is the end.
  using Step = GoalPursuit::Step;

  /// @param time microseconds
  /// @param people whom a tracker sees now
  Step step(std::int64_t time, const Pose2& robot, std::span<const SeenPerson> people,
            const PursuitSurroundings& around);

  /// Whom it follows now: a person who was lost for a while may have got another id.
  std::int64_t person() const { return person_.id(); }
  /// Way from the robot to the person, metres; 0 before the first sight.
  double way() const { return way_; }

private:
  struct Failure {
    std::int64_t time = 0;
    Point2 place;
  };

  void note(const SeenPerson& x);
  Step follow(const Pose2& robot, const PursuitSurroundings& around);
  Step search(const Pose2& robot, const PursuitSurroundings& around);
  /// The newest place of the trail where the robot fits.
  std::optional<Point2> goal_on_trail(const PlanningMap& map) const;
  bool fits(const Point2& place, const PlanningMap& map) const;
  Step pursue(const Pose2& robot, const Point2& goal, const PursuitSurroundings& around);
  /// The pursuit found no way: it waits, and gives up if that lasts.
  Step wait_for_way(const Pose2& robot, const std::string& reason);
  /// Speed that keeps the distance, m/s.
  double speed_behind(const Pose2& robot, const PlanningMap& map);
  /// The same at which the robot stops before the points; the person may not be one of those who
  /// are there.
  double speed_before(const Pose2& robot, const Twist2& wanted,
                      std::span<const Point2> points) const;
  Step turn_towards(const Pose2& robot, const Point2& place, const std::string& waits_for);
  Step fail(const std::string& reason) const;

  FollowPersonOptions options_;
  FollowedPerson person_;
  /// Where the person walked; the last is the newest place.
  std::deque<Point2> trail_;
  std::optional<SeenPerson> last_;
  std::optional<GoalPursuit> pursuit_;
  std::int64_t time_ = 0;
  std::optional<std::int64_t> begun_;
  std::int64_t seen_time_ = 0;
  double way_ = 0;
  /// What it looks at beyond the last place, once.
  bool has_looked_beyond_ = false;
  /// The first of the failures near one place.
  std::optional<Failure> failure_;
  std::int64_t failed_last_ = 0;
};

} // namespace castor::mapping
