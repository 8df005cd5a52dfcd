// A robot follows a person, whom it knows of by a tracker that sees as the test says.

#include "castor/mapping/movement/person_follower.hpp"

#include "castor/mapping/planar/poses.hpp"
#include "castor/tests/mapping/movement/drawn_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace castor::mapping {

namespace {

using testing::HasSubstr;

using Walk = std::function<std::optional<SeenPerson>(double)>;

struct Followed {
  PersonFollower::Step last;
  Pose2 robot;
  double seconds = 0;
  /// Least distances from the person, and from what the laser sees; metres.
  double nearest = 100;
  double nearest_seen = 100;
};

/// Follows until that time, seconds, or until it fails, without inertia.
/// @param seen what the laser sees besides
Followed follow(PersonFollower& follower, Pose2 robot, const Walk& person, double until,
                const CellMap& cells = test::empty_room(20, 8), std::vector<Point2> seen = {}) {
  PlanningMap map;
  map.update(cells, 1);
  constexpr double dt = 0.05;
  Followed result;
  for (int i = 0; i * dt < until; ++i) {
    const double time = i * dt;
    std::vector<SeenPerson> people;
    if (const auto x = person(time)) {
      people.push_back(*x);
      result.nearest = std::min(result.nearest, distance(x->place, {robot.x, robot.y}));
    }
    result.last = follower.step(static_cast<std::int64_t>(time * 1e6), robot, people, {map, seen});
    result.seconds = time;
    if (result.last.status == MovementStatus::failed)
      break;
    robot = moved(robot, result.last.velocity, dt);
    for (const auto& x : seen)
      result.nearest_seen = std::min(result.nearest_seen, distance(x, {robot.x, robot.y}));
  }
  result.robot = robot;
  return result;
}

SeenPerson walks_along_x(double time, double speed = 0.6) {
  return {7, {4 + speed * time, 4}, 0, speed};
}

} // namespace

TEST(PersonFollower, KeepsItsDistance) {
  PersonFollower follower{7, {}};
  const auto x = follow(
    follower, {2, 4, 0}, [](double t) { return walks_along_x(t); }, 20);
  EXPECT_EQ(x.last.status, MovementStatus::moving);
  EXPECT_NEAR(distance(walks_along_x(x.seconds).place, {x.robot.x, x.robot.y}), 1.2, 0.15);
}

TEST(PersonFollower, StandsBehindSomebodyWhoStands) {
  PersonFollower follower{7, {}};
  const auto stops = [](double t) {
    auto x = walks_along_x(std::min(t, 5.0));
    x.speed = t < 5 ? x.speed : 0;
    return x;
  };
  const auto x = follow(follower, {2, 4, 0}, stops, 20);
  EXPECT_EQ(x.last.status, MovementStatus::waiting);
  EXPECT_EQ(x.last.velocity, (Twist2{}));
  EXPECT_NEAR(distance(stops(20).place, {x.robot.x, x.robot.y}), 1.2, 0.25);
  EXPECT_GT(x.nearest, 0.8);
}

TEST(PersonFollower, FacesAPersonWhoComesNear) {
  PersonFollower follower{7, {}};
  const auto stands = [](double) { return SeenPerson{7, {4, 4.7}, 0, 0}; };
  const auto x = follow(follower, {4, 4, 0}, stands, 5);
  EXPECT_NEAR(x.robot.heading, 1.57, 0.15);
  EXPECT_NEAR(distance(Point2{4, 4}, {x.robot.x, x.robot.y}), 0, 0.01);
}

TEST(PersonFollower, FollowsAroundACornerOnThePersonsWay) {
  // A wall from (3, 1) on to the right, around whose end the person walks.
  auto cells = test::empty_room(10, 8);
  test::fill(cells, 3, 2.5, 10, 2.8);
  const auto walks = [](double t) -> std::optional<SeenPerson> {
    const double way = 0.5 * t;
    if (way < 3)
      return SeenPerson{7, {5 - way, 1.5}, 3.14, 0.5};
    if (way < 5.5)
      return SeenPerson{7, {2, 1.5 + way - 3}, 1.57, 0.5};
    return SeenPerson{7, {2 + std::min(way - 5.5, 4.0), 4}, 0, way < 9.5 ? 0.5 : 0};
  };
  PersonFollower follower{7, {}};
  const auto x = follow(follower, {6.3, 1.5, 3.14}, walks, 25, cells);
  EXPECT_NEAR(distance(walks(25)->place, {x.robot.x, x.robot.y}), 1.2, 0.25);
  EXPECT_NEAR(x.robot.y, 4, 0.2) << "on the other side of the wall";
}

TEST(PersonFollower, DrivesAroundAThingThatTheMapDoesNotHave) {
  PersonFollower follower{7, {}};
  std::vector<Point2> box;
  for (double aside = -0.3; aside < 0.31; aside += 0.05)
    box.push_back({6, 4 + aside});
  const auto stops = [](double t) {
    auto x = walks_along_x(std::min(t, 10.0));
    x.speed = t < 10 ? x.speed : 0;
    return x;
  };
  const auto x = follow(follower, {2, 4, 0}, stops, 40, test::empty_room(20, 8), box);
  EXPECT_NEAR(distance(stops(40).place, {x.robot.x, x.robot.y}), 1.2, 0.25);
  EXPECT_GT(x.nearest_seen, 0.25) << "the robot's radius";
}

TEST(PersonFollower, GivesUpWhomItCannotReach) {
  auto cells = test::empty_room(20, 8);
  test::fill(cells, 8, 0, 8.2, 8);
  const auto behind = [](double) { return SeenPerson{7, {10, 4}, 0, 0}; };
  PersonFollower follower{7, {}};
  const auto x = follow(follower, {2, 4, 0}, behind, 60, cells);
  EXPECT_EQ(x.last.status, MovementStatus::failed);
  EXPECT_THAT(x.last.reason, HasSubstr("could not be reached from 2.00 4.00 for 15 s: no way"));
  EXPECT_NEAR(x.seconds, 15, 1);
}

TEST(PersonFollower, GoesToWhereSomebodyWasLastSeenAndGivesUpWithAReason) {
  PersonFollower follower{7, {}};
  const auto vanishes = [](double t) {
    return t < 5 ? std::optional{walks_along_x(t)} : std::nullopt;
  };
  const auto x = follow(follower, {2, 4, 0}, vanishes, 60);
  EXPECT_EQ(x.last.status, MovementStatus::failed);
  EXPECT_THAT(x.last.reason, HasSubstr("out of sight for 15 s, last seen at 6.97 4.00"));
  EXPECT_NEAR(x.seconds, 20, 0.5);
  EXPECT_GT(x.robot.x, 6.5);
  EXPECT_NEAR(x.robot.y, 4, 0.2);
}

TEST(PersonFollower, GivesUpWhoNeverCame) {
  PersonFollower follower{7, {}};
  const auto x = follow(
    follower, {2, 4, 0}, [](double) { return std::nullopt; }, 60);
  EXPECT_EQ(x.last.status, MovementStatus::failed);
  EXPECT_THAT(x.last.reason, HasSubstr("person 7 was not in sight for 15 s"));
}

TEST(FollowedPerson, SomebodyNewWhereThePersonHasToBeIsThePerson) {
  FollowedPerson followed{7, {}};
  const std::vector<SeenPerson> before{{7, {2, 0}, 0, 0.5}, {8, {2.5, 0}, 0, 0}};
  EXPECT_EQ(followed.find(before, 0)->id, 7);
  const std::vector<SeenPerson> after{{8, {2.5, 0}, 0, 0}, {9, {3, 0.4}, 0, 0.5}};
  EXPECT_EQ(followed.find(after, 2'000'000)->id, 9) << "8 was there before, beside 7";
  EXPECT_EQ(followed.id(), 9);
}

TEST(FollowedPerson, SomebodyNewElsewhereIsSomebodyElse) {
  FollowedPerson followed{7, {}};
  const std::vector<SeenPerson> before{{7, {2, 0}, 0, 0.5}};
  EXPECT_EQ(followed.find(before, 0)->id, 7);
  const std::vector<SeenPerson> after{{9, {8, 3}, 0, 0.5}};
  EXPECT_FALSE(followed.find(after, 2'000'000));
  EXPECT_EQ(followed.id(), 7);
}

TEST(FollowedPerson, SomebodyNewWhoWalksOnWhereTheTrackStopsIsThePerson) {
  FollowedPerson followed{7, {}};
  const auto at = [](std::int64_t id, double x, double y, double speed) {
    return SeenPerson{id, {x, y}, 0, speed};
  };
  EXPECT_EQ(followed.find(std::vector{at(7, 2, 0, 0.6)}, 0)->id, 7);
  // The track stays at a wall beside the way.
  EXPECT_EQ(followed.find(std::vector{at(7, 2, 0.4, 0.1)}, 500'000)->id, 7);
  const std::vector<SeenPerson> after{at(7, 2, 0.4, 0), at(8, 0.5, 0, 0.6), at(9, 2.9, 0, 0.6)};
  EXPECT_EQ(followed.find(after, 1'500'000)->id, 9);
}

TEST(FollowedPerson, WhoStopsIsStillThePersonWhenSomebodyWalksBy) {
  FollowedPerson followed{7, {}};
  const SeenPerson before{7, {2, 0}, 0, 0.6};
  const SeenPerson stands{7, {2.2, 0}, 0, 0};
  EXPECT_EQ(followed.find(std::vector{before}, 0)->id, 7);
  EXPECT_EQ(followed.find(std::vector{stands}, 500'000)->id, 7);
  const SeenPerson comes{9, {2.9, 0}, 3, 0.6};
  EXPECT_EQ(followed.find(std::vector{stands, comes}, 1'500'000)->id, 7) << "the other way";
  const SeenPerson passes{10, {4, 0}, 0, 0.6};
  EXPECT_EQ(followed.find(std::vector{stands, passes}, 5'000'000)->id, 7) << "much later";
}

TEST(FollowedPerson, WhoComesTheOtherWayIsSomebodyElse) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  EXPECT_FALSE(followed.find(std::vector{SeenPerson{9, {2.5, 0}, 3, 0.6}}, 2'000'000));
  EXPECT_EQ(followed.find(std::vector{SeenPerson{10, {3, 0}, 0.2, 0.6}}, 2'000'000)->id, 10);
}

TEST(FollowedPerson, WhoComesOutOfHidingTheOtherWayIsSomebodyElseWithTheSameId) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  const SeenPerson comes{7, {2.5, 0}, 3, 0.6};
  EXPECT_FALSE(followed.find(std::vector{comes}, 2'000'000));
  EXPECT_FALSE(followed.find(std::vector{SeenPerson{7, {2.5, 0}, 0, 0}}, 2'100'000))
    << "and remains somebody else";
  EXPECT_EQ(followed.find(std::vector{comes, SeenPerson{9, {3.2, 0}, 0, 0.6}}, 2'500'000)->id, 9);
}

TEST(FollowedPerson, WhoTurnsBackInSightIsStillThePerson) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 3, 0.6}}, 200'000)->id, 7);
}

namespace {

SeenPerson on_line(std::int64_t id, double x, double heading) {
  return {id, {x, 0}, heading, 0.6};
}

/// The person, 7, and somebody who comes towards it, for half a second.
FollowedPerson before_meeting() {
  FollowedPerson result{7, {}};
  for (const double t : {0.0, 0.25, 0.5})
    result.find(std::vector{on_line(7, 2 + 0.6 * t, 0), on_line(8, 3 - 0.6 * t, 3.14)},
                static_cast<std::int64_t>(t * 1e6));
  return result;
}

} // namespace

TEST(FollowedPerson, TwoWhoCrossSwapTracks) {
  auto followed = before_meeting();
  followed.find(std::vector{on_line(7, 2.4, 3.14), on_line(8, 2.6, 0)}, 750'000);
  const auto x = followed.find(std::vector{on_line(7, 2.2, 3.14), on_line(8, 2.8, 0)}, 1'000'000);
  ASSERT_TRUE(x);
  EXPECT_EQ(x->id, 8);
}

TEST(FollowedPerson, WhoTakesOverTheTrackWhereTwoMeetIsSomebodyElse) {
  auto followed = before_meeting();
  followed.find(std::vector{on_line(7, 2.4, 3.14)}, 750'000);
  EXPECT_FALSE(followed.find(std::vector{on_line(7, 2.2, 3.14)}, 1'000'000));
  const auto x = followed.find(std::vector{on_line(7, 1.1, 3.14), on_line(9, 3.5, 0)}, 3'000'000);
  ASSERT_TRUE(x);
  EXPECT_EQ(x->id, 9);
}

TEST(FollowedPerson, WhoWalksTowardsWhereThePersonWasLostIsSomebodyElse) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  EXPECT_FALSE(followed.find(std::vector{SeenPerson{9, {3.8, 1}, -1.9, 0.6}}, 4'000'000));
  EXPECT_EQ(followed.find(std::vector{SeenPerson{10, {3.6, 1.2}, 1.3, 0.6}}, 4'000'000)->id, 10);
}

TEST(FollowedPerson, WhoStandsElsewhereIsSomebodyElse) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  EXPECT_FALSE(followed.find(std::vector{SeenPerson{9, {2.5, 1.4}, 1.6, 0}}, 4'000'000));
  EXPECT_EQ(followed.find(std::vector{SeenPerson{10, {2.5, 0.5}, 0, 0}}, 4'000'000)->id, 10);
}

TEST(FollowedPerson, NobodyIsFasterThanBefore) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  const SeenPerson far{9, {5, 0}, 0, 0.6};
  EXPECT_FALSE(followed.find(std::vector{far}, 2'000'000));
  EXPECT_EQ(followed.find(std::vector{far}, 4'000'000)->id, 9);
}

TEST(FollowedPerson, WhoCameTheOtherWayStaysSomebodyElseWhenHeTurns) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  EXPECT_FALSE(followed.find(std::vector{SeenPerson{9, {3, 0}, 3, 0.6}}, 2'000'000));
  EXPECT_FALSE(followed.find(std::vector{SeenPerson{9, {2.6, 0}, 1, 0.6}}, 3'000'000));
}

TEST(FollowedPerson, DoubtBeginsWhenTheTrackTurnsNotWhenThePersonWasSeenLast) {
  FollowedPerson followed{7, {}};
  EXPECT_EQ(followed.find(std::vector{SeenPerson{7, {2, 0}, 0, 0.6}}, 0)->id, 7);
  const SeenPerson aside{7, {2.5, 0.5}, 1.6, 0.6};
  EXPECT_EQ(followed.find(std::vector{aside}, 3'500'000)->id, 7);
  const std::vector<SeenPerson> after{aside, {9, {3.9, 0}, 0, 0.6}};
  EXPECT_EQ(followed.find(after, 4'500'000)->id, 9);
}

} // namespace castor::mapping
