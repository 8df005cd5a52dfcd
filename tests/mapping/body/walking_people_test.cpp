#include "castor/mapping/body/walking_people.hpp"

#include "castor/mapping/body/mutual_avoidance.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

constexpr Disc far_robot{{100, 100}, 0.25};

bool is_always_free(const Point2&) {
  return true;
}

/// People in a building, who walk for some seconds.
class Simulated {
public:
  Simulated(const std::string& text, bool considerate)
    : building_(parse_building(
                  "wall 0 0 to 12 0 to 12 6 to 0 6 close thickness 0.2\nstart 1 1\n" + text, "")
                  .building),
      obstacles_(between_heights(solids_of(building_), 0, 2)),
      people_(building_.people, considerate) {}

  void walk(double seconds, const std::function<void()>& check = {}) {
    for (int i = 0; i < seconds / dt; ++i) {
      people_.step(dt, robot, obstacles_);
      if (check)
        check();
    }
  }

  Point2 place(std::size_t i) const { return people_.discs()[i].centre; }
  double apart() const { return distance(place(0), place(1)); }
  double room(std::size_t i) const { return obstacles_.clearance(place(i), 1); }

  static constexpr double dt = 0.01;
  Disc robot = far_robot;

private:
  Building building_;
  SolidObstacles obstacles_;
  WalkingPeople people_;
};

const std::string two_who_meet = "person ann route 2 3 to 10 3 speed 0.8\n"
                                 "person bob route 10 3.1 to 2 3.1 speed 0.6\n";

} // namespace

TEST(WalkingPeople, WhoShowsARobotAroundWaitsForIt) {
  Walker guide;
  guide.route = {{2, 3}, {10, 3}};
  guide.speed = 0.8;
  guide.leads_within = 4;
  const SolidObstacles nothing{std::span<const Solid>{}};
  for (const bool considerate : {false, true}) {
    WalkingPeople people({guide}, considerate);
    const auto walk = [&](const Point2& robot, double seconds) {
      for (int i = 0; i < seconds / Simulated::dt; ++i)
        people.step(Simulated::dt, {robot, 0.25}, nothing);
      return people.discs()[0].centre.x;
    };
    EXPECT_NEAR(walk({1, 3}, 1), 2.8, 0.02) << "as fast as ever";
    const double stands = walk({1, 3}, 30);
    EXPECT_NEAR(stands, 5, 0.1) << "4 m before the robot";
    EXPECT_NEAR(walk({2.5, 3}, 0.5), stands + 0.27, 0.1) << "slower";
  }
}

TEST(MutualAvoidance, TellsTheTimeToContact) {
  EXPECT_DOUBLE_EQ(time_to_contact({3, 0}, {-1, 0}, 1, 5), 2);
  EXPECT_DOUBLE_EQ(time_to_contact({3, 1.1}, {-1, 0}, 1, 5), 5) << "it passes";
  EXPECT_DOUBLE_EQ(time_to_contact({3, 0}, {1, 0}, 1, 5), 5) << "it goes away";
  EXPECT_DOUBLE_EQ(time_to_contact({30, 0}, {-1, 0}, 1, 5), 5) << "it is far away";
  EXPECT_DOUBLE_EQ(time_to_contact({0.5, 0}, {-1, 0}, 1, 5), 0);
  EXPECT_DOUBLE_EQ(time_to_contact({0.5, 0}, {1, 0}, 1, 5), 5) << "they part";
}

TEST(MutualAvoidance, GoesAsWantedWhereNobodyIsInTheWay) {
  const std::vector<AvoidedDisc> others{{{3, 1}, {-1, 0}, 0.5, true}};
  EXPECT_EQ(velocity_among({}, {1, 0}, {1, 0}, others, is_always_free), (Point2{1, 0}));
}

TEST(MutualAvoidance, EvadesToTheRight) {
  const std::vector<AvoidedDisc> others{{{2, 0}, {-1, 0}, 0.5, true}};
  const auto velocity = velocity_among({}, {1, 0}, {1, 0}, others, is_always_free);
  EXPECT_GT(velocity.x, 0.6);
  EXPECT_LT(velocity.y, -0.1);
}

TEST(MutualAvoidance, DoesAllThatIsNecessaryForOneWhoDoesNot) {
  std::vector<AvoidedDisc> others{{{1.5, 0}, {-1, 0}, 0.5, true}};
  const auto aside = [&] {
    return std::abs(velocity_among({}, {1, 0}, {1, 0}, others, is_always_free).y);
  };
  const double half = aside();
  others[0].is_mutual = false;
  EXPECT_GT(aside(), half);
}

TEST(MutualAvoidance, EvadesToTheLeftWhereAWallIsOnTheRight) {
  const std::vector<AvoidedDisc> others{{{2, 0}, {-1, 0}, 0.5, true}};
  const auto velocity =
    velocity_among({}, {1, 0}, {1, 0}, others, [](const Point2& x) { return x.y >= 0; });
  EXPECT_GT(velocity.y, 0.1);
}

TEST(MutualAvoidance, StandsWhereThereIsNoWay) {
  const std::vector<AvoidedDisc> others{{{0.6, 0}, {}, 0.5, false}};
  const auto velocity =
    velocity_among({}, {1, 0}, {1, 0}, others, [](const Point2&) { return false; });
  EXPECT_EQ(velocity, (Point2{}));
}

TEST(WalkingPeople, WalkThroughOneAnotherIfTheyAreNotConsiderate) {
  Simulated x{two_who_meet, false};
  double least = 9;
  x.walk(8, [&] { least = std::min(least, x.apart()); });
  EXPECT_NEAR(least, 0.1, 0.01);
  EXPECT_NEAR(x.place(0).x, 2 + 8 * 0.8, 0.02);
}

TEST(WalkingPeople, PassOneAnotherWithoutStandingAndReturnToTheirRoutes) {
  Simulated x{two_who_meet, true};
  double least = 9;
  x.walk(9, [&] { least = std::min(least, x.apart()); });
  EXPECT_GT(least, 0.5);
  EXPECT_NEAR(x.place(0).x, 2 + 9 * 0.8, 0.3);
  EXPECT_NEAR(x.place(1).x, 10 - 9 * 0.6, 0.3);
  x.walk(3);
  EXPECT_NEAR(x.place(0).y, 3, 0.1);
  EXPECT_NEAR(x.place(1).y, 3.1, 0.1);
}

TEST(WalkingPeople, KeepToTheirRoutesExactlyAsLongAsTheyMeetNobody) {
  Simulated considerate{"person ann route 2 3 to 8 3 to 8 5 speed 0.8 pause 1\n", true};
  Simulated other{"person ann route 2 3 to 8 3 to 8 5 speed 0.8 pause 1\n", false};
  considerate.walk(30, [&] {
    other.walk(Simulated::dt);
    ASSERT_LT(distance(considerate.place(0), other.place(0)), 1e-9);
  });
}

TEST(WalkingPeople, OvertakeWhoIsSlower) {
  Simulated x{"person ann route 2 3 to 11 3 speed 1.2\nperson bob route 4 3 to 11 3 speed 0.4\n",
              true};
  double least = 9;
  x.walk(6.5, [&] { least = std::min(least, x.apart()); });
  EXPECT_GT(least, 0.5);
  EXPECT_GT(x.place(0).x, x.place(1).x + 0.5);
}

TEST(WalkingPeople, KeepClearOfWallsWhenTheyEvade) {
  Simulated x{"wall 1 2.2 to 11 2.2\nwall 1 3.9 to 11 3.9\n" + two_who_meet, true};
  double least = 9;
  double room = 9;
  x.walk(12, [&] {
    least = std::min(least, x.apart());
    room = std::min({room, x.room(0), x.room(1)});
  });
  EXPECT_GT(least, 0.45);
  EXPECT_GT(room, 0.19);
}

TEST(WalkingPeople, SqueezePastOneAnotherInADoor) {
  Simulated x{"wall 6 0 to 6 6\ndoor d at 6 3 width 0.85\nperson ann route 2 3 to 10 3 speed 0.8\n"
              "person bob route 10 3 to 2 3 speed 0.8\n",
              true};
  double farthest = 0;
  double bobs = 9;
  x.walk(18, [&] {
    farthest = std::max(farthest, x.place(0).x);
    bobs = std::min(bobs, x.place(1).x);
  });
  EXPECT_GT(farthest, 8);
  EXPECT_LT(bobs, 4);
}

TEST(WalkingPeople, WalkPastARobot) {
  Simulated x{"person ann route 2 3 to 10 3 speed 0.8\n", true};
  x.robot = {{6, 3}, 0.25};
  double least = 9;
  x.walk(8, [&] { least = std::min(least, distance(x.place(0), x.robot.centre)); });
  EXPECT_GT(least, 0.59);
  EXPECT_GT(x.place(0).x, 6.9);
}

TEST(WalkingPeople, NeverStandForLongAndNeverRunIntoOneAnotherInACorridor) {
  Simulated x{"wall 0 2 to 12 2\nwall 0 3.7 to 12 3.7\n"
              "person a route 1 2.8 to 11 2.8 speed 1\nperson b route 11 2.7 to 1 2.7 speed 0.7\n"
              "person c route 3 2.9 to 11 2.9 speed 0.6\nperson d route 8 3 to 1 3 speed 0.9\n",
              true};
  x.robot = {{6, 2.4}, 0.25};
  std::vector<Point2> from;
  std::vector<double> since(4);
  for (std::size_t i = 0; i < 4; ++i)
    from.push_back(x.place(i));
  x.walk(300, [&] {
    for (std::size_t i = 0; i < 4; ++i) {
      since[i] += Simulated::dt;
      if (distance(x.place(i), from[i]) > 0.3) {
        from[i] = x.place(i);
        since[i] = 0;
      }
      ASSERT_LT(since[i], 15) << i << " stands at " << from[i].x << ' ' << from[i].y;
      ASSERT_GT(distance(x.place(i), x.robot.centre), 0.5);
    }
  });
}

} // namespace castor::mapping
