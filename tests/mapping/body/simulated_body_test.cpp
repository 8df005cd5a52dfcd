#include "castor/mapping/body/simulated_body.hpp"

#include "castor/mapping/body/body_state_text.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/building/building_file.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace castor::mapping {

namespace {

using std::numbers::pi;

Building building_with(const std::string& more) {
  auto read = parse_building("wall 0 0 to 8 0 to 8 5 to 0 5 close thickness 0.2\n" + more, "");
  EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
  return read.building;
}

BodyOptions exact_body() {
  BodyOptions result;
  result.drive.slip = 0;
  result.drive.diameter_error = 0;
  return result;
}

SimulatedBody body_in(const Building& x, const BodyOptions& options) {
  return SimulatedBody(surroundings_in(x, options), options);
}

void run(SimulatedBody& x, const Twist2& velocity, double seconds) {
  x.command(velocity);
  for (int i = 0; i < static_cast<int>(std::lround(seconds * 100)); ++i)
    x.step();
}

} // namespace

TEST(SimulatedBody, StandsUntilItIsCommanded) {
  auto x = body_in(building_with("start 2 2 heading 90\n"), {});
  run(x, {}, 1);
  auto status = x.status();
  EXPECT_EQ(status.pose, (Pose2{2, 2, pi / 2}));
  EXPECT_EQ(status.time, 1'000'000);
  EXPECT_EQ(status.driven, 0);
  EXPECT_EQ(x.odometry().pose, Pose2{});
}

TEST(SimulatedBody, StopsWhenItsCommandHoldsNoLonger) {
  auto options = exact_body();
  auto x = body_in(building_with("start 2 2\n"), options);
  using namespace std::chrono_literals;
  x.command({0.4, 0}, 600ms);
  for (int i = 0; i < 60; ++i)
    x.step();
  EXPECT_NEAR(x.status().velocity.forward, 0.4, 1e-9);
  x.step();
  EXPECT_LT(x.status().velocity.forward, 0.395);
  for (int i = 0; i < 50; ++i)
    x.step();
  EXPECT_EQ(x.status().velocity.forward, 0);
  // A new command holds again.
  x.command({0.4, 0}, 600ms);
  x.step();
  EXPECT_GT(x.status().velocity.forward, 0);
}

TEST(SimulatedBody, OdometryIsInItsOwnFrame) {
  auto options = exact_body();
  options.odometry_start = {10, 10, 0};
  auto x = body_in(building_with("start 2 2 heading 90\n"), options);
  run(x, {0.5, 0}, 3);
  auto status = x.status();
  EXPECT_GT(status.pose.y, 3);
  EXPECT_NEAR(status.pose.x, 2, 1e-9);
  EXPECT_NEAR(x.odometry().pose.x - 10, status.pose.y - 2, 1e-9);
  EXPECT_NEAR(x.odometry().velocity.forward, 0.5, 1e-9);
  EXPECT_NEAR(status.driven, status.pose.y - 2, 1e-9);
}

TEST(SimulatedBody, CollisionStopsItAndIsCountedOnce) {
  auto x = body_in(building_with("start 6 2\n"), exact_body());
  run(x, {0.8, 0}, 5);
  auto status = x.status();
  EXPECT_EQ(status.collisions, 1);
  EXPECT_TRUE(status.blocked);
  // The wall is at 7.9, and the robot has a radius of 0.25.
  EXPECT_LE(status.pose.x, 7.65);
  EXPECT_GT(status.pose.x, 7.64);
  EXPECT_GE(status.clearance, 0);
  EXPECT_EQ(status.velocity, Twist2{});
  EXPECT_LT(x.odometry().pose.x, 1.66) << "its wheels stand, too";
  // It may turn, and drive away.
  run(x, {0, 1}, 1);
  EXPECT_GT(x.status().pose.heading, 0.7);
  run(x, {-0.5, 0}, 2);
  status = x.status();
  EXPECT_FALSE(status.blocked);
  EXPECT_LT(status.pose.x, 7.4);
  run(x, {0.5, 0}, 5);
  EXPECT_EQ(x.status().collisions, 2);
  EXPECT_LT(x.status().least_clearance, 0.009) << "within the step of a collision";
}

TEST(SimulatedBody, CanTurnWhereItTouches) {
  // Slip does not push it into the wall, and does not count as a collision.
  BodyOptions options;
  options.drive.slip = 0.01;
  auto x = body_in(building_with("start 7 2\n"), options);
  run(x, {0.8, 0}, 5);
  ASSERT_EQ(x.status().collisions, 1);
  run(x, {}, 1);
  run(x, {0, 1}, 3);
  EXPECT_EQ(x.status().collisions, 1);
  EXPECT_GT(x.status().pose.heading, 2.5);
}

TEST(SimulatedBody, DrivesThroughOpenDoorsOnly) {
  const std::string two_rooms = "wall 5 0 to 5 5\nstart 3 2.5\ndoor d at 5 2.5 width 0.85 ";
  auto open = body_in(building_with(two_rooms + "open\n"), exact_body());
  run(open, {0.5, 0}, 8);
  EXPECT_EQ(open.status().collisions, 0);
  EXPECT_GT(open.status().pose.x, 6);
  EXPECT_NEAR(open.status().least_clearance, 0.425 - 0.25, 0.002) << "within the door";
  auto shut = body_in(building_with(two_rooms + "shut\n"), exact_body());
  run(shut, {0.5, 0}, 8);
  EXPECT_EQ(shut.status().collisions, 1);
  EXPECT_LT(shut.status().pose.x, 5);
}

TEST(SimulatedBody, DrivesBelowWhatIsHigherThanIt) {
  auto x = body_in(building_with("start 2 2\nfurniture shelf at 4 2 box 0.3 4 0.3 on 0.6\n"),
                   exact_body());
  run(x, {0.5, 0}, 6);
  EXPECT_EQ(x.status().collisions, 0);
  EXPECT_GT(x.status().pose.x, 4.5);
}

RC_GTEST_PROP(SimulatedBody, NeverIsWithinAnObstacle, ()) {
  static const auto office = load_building(CASTOR_CONFIGS "/buildings/office.building").building;
  BodyOptions options;
  options.seed = *rc::gen::arbitrary<std::uint64_t>();
  options.people = true;
  auto x = body_in(office, options);
  const auto commands = *rc::gen::inRange(1, 30);
  for (int i = 0; i < commands; ++i) {
    run(x, {*rc::gen::inRange(-8, 9) / 10.0, *rc::gen::inRange(-16, 17) / 10.0}, 2);
    RC_ASSERT(x.status().clearance >= -1e-9);
  }
  RC_ASSERT(x.status().least_clearance >= -1e-9);
  RC_ASSERT(room_at(office, {x.status().pose.x, x.status().pose.y}) != nullptr);
}

TEST(SimulatedBody, PeopleWalkAndWaitForTheRobot) {
  // There is no room to walk around it.
  const std::string text = "wall 1 2 to 7 2\nwall 1 3 to 7 3\nstart 4 2.5\n"
                           "person ann route 1 2.5 to 7 2.5 speed 1\n";
  auto options = exact_body();
  auto without = body_in(building_with(text), options);
  EXPECT_TRUE(without.people().discs().empty());
  options.people = true;
  auto x = body_in(building_with(text), options);
  run(x, {}, 1.5);
  EXPECT_NEAR(x.people().discs()[0].centre.x, 2.5, 1e-9);
  // Ann waits before the robot.
  run(x, {}, 1.5);
  EXPECT_NEAR(x.people().discs()[0].centre.x, 4 - 0.25 - 0.25 - 0.2, 0.011);
  EXPECT_EQ(x.status().collisions, 0);
  EXPECT_LT(x.scan().ranges[90], 3.9);
  run(x, {-0.5, 0}, 1);
  EXPECT_EQ(x.status().collisions, 1) << "the robot runs into her, backwards";
}

TEST(SimulatedBody, PeoplePauseAtThePointsOfTheirRoutes) {
  auto options = exact_body();
  options.people = true;
  auto x =
    body_in(building_with("start 6 1\nperson ann route 1 2.5 to 3 2.5 speed 1 pause 2\n"), options);
  run(x, {}, 3.9);
  EXPECT_NEAR(x.people().discs()[0].centre.x, 3, 0.02);
  run(x, {}, 1.1);
  EXPECT_NEAR(x.people().discs()[0].centre.x, 2, 0.05);
}

TEST(SimulatedBody, PeopleWalkAroundARobotThatStands) {
  auto options = exact_body();
  options.people = true;
  auto x =
    body_in(building_with("start 4 2.5\nperson ann route 1 2.5 to 7 2.5 speed 1\n"), options);
  double farthest_aside = 0;
  double nearest = 1e9;
  for (int i = 0; i < 80; ++i) {
    run(x, {}, 0.1);
    const auto ann = x.people().discs()[0].centre;
    farthest_aside = std::max(farthest_aside, std::abs(ann.y - 2.5));
    nearest = std::min(nearest, distance(ann, {4, 2.5}));
  }
  EXPECT_GT(farthest_aside, 0.55);
  EXPECT_GT(nearest, 0.5 + 0.09);
  EXPECT_GT(x.people().discs()[0].centre.x, 5);
  EXPECT_NEAR(x.people().discs()[0].centre.y, 2.5, 0.01) << "on her route again";
  EXPECT_EQ(x.status().collisions, 0);
}

TEST(SimulatedBody, PeopleTurnBackWhereThereIsNoRoomToWalkAround) {
  auto options = exact_body();
  options.people = true;
  auto x = body_in(building_with("wall 1 2 to 7 2\nwall 1 3 to 7 3\nstart 4 2.5\n"
                                 "person ann route 1 2.5 to 7 2.5 speed 1\n"),
                   options);
  // There after 2.3 s, she waits, looks for a way around, and is back at the beginning then.
  double least = 9;
  run(x, {}, 2.3 + 1 + 6);
  for (int i = 0; i < 30; ++i) {
    run(x, {}, 0.1);
    least = std::min(least, x.people().discs()[0].centre.x);
  }
  EXPECT_LT(least, 1.1);
  EXPECT_GT(x.people().discs()[0].centre.x, 1.1) << "and comes again";
  EXPECT_EQ(x.status().collisions, 0);
}

TEST(SimulatedBody, IsTheSameForTheSameSeed) {
  auto office = load_building(CASTOR_CONFIGS "/buildings/office.building").building;
  auto drive = [&](std::uint64_t seed, bool look) {
    BodyOptions options;
    options.seed = seed;
    options.people = true;
    auto x = body_in(office, options);
    for (int i = 0; i < 20; ++i) {
      run(x, {0.5, 0.2 * (i % 3 - 1)}, 0.5);
      if (look)
        x.scan();
    }
    return std::pair{x.status(), x.odometry()};
  };
  EXPECT_EQ(drive(3, false), drive(3, false));
  EXPECT_EQ(drive(3, false), drive(3, true)) << "whoever looks changes nothing";
  EXPECT_NE(drive(3, false), drive(4, false));
}

TEST(SimulatedBody, StateOutlivesIt) {
  auto first = body_in(building_with("start 6 2\n"), {});
  run(first, {0.8, 0.1}, 5);
  const SavedBody saved{5'000'000, first.state()};
  const auto read = parse_body_state(body_state_text(saved));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, saved) << "without loss";
  auto second = body_in(building_with("start 6 2\n"), {});
  second.resume(read->state);
  EXPECT_EQ(second.status().pose, first.status().pose);
  EXPECT_EQ(second.odometry().pose, first.odometry().pose);
  EXPECT_EQ(second.status().collisions, 1);
  EXPECT_EQ(second.status().clearance, first.status().clearance);
  run(second, {-0.5, 0}, 2);
  EXPECT_LT(second.status().pose.x, 7.3);
  for (auto* text : {"", "body 1 2", "body 1 2 3 4 5 6 7 8 9 x", "robot 1 2 3 4 5 6 7 8 9 10",
                     "body 1e300 2 3 4 5 6 7 8 9 10"})
    EXPECT_FALSE(parse_body_state(text)) << text;
}

TEST(SimulatedBody, RefusesStepsInWhichItCouldPassThroughSomething) {
  auto options = exact_body();
  options.step = std::chrono::seconds{1};
  EXPECT_THROW(body_in(building_with("start 2 2\n"), options), std::invalid_argument);
}

TEST(SimulatedBody, RefusesAStartWhereItDoesNotFit) {
  const auto hall = building_with("start 2 2\nfurniture box at 5 2 box 1 1 1\n");
  for (double x : {0.3, 4.3, 5.0}) {
    auto surroundings = surroundings_in(hall, {});
    surroundings.start = {x, 2, 0};
    EXPECT_THROW(SimulatedBody(std::move(surroundings), {}), std::invalid_argument) << x;
  }
  auto surroundings = surroundings_in(hall, {});
  surroundings.start = {4.2, 2, 0};
  EXPECT_NO_THROW(SimulatedBody(std::move(surroundings), {}));
}

TEST(SimulatedBody, DrivesAlongThePathOfTheOffice) {
  auto office = load_building(CASTOR_CONFIGS "/buildings/office.building").building;
  const auto text = load_text(CASTOR_CONFIGS "/buildings/office.path");
  auto path = parse_path(text, "office.path");
  ASSERT_TRUE(path.problems.empty()) << render(path.problems);
  BodyOptions options;
  auto x = body_in(office, options);
  PathFollower follower(path.path, {});
  std::vector<std::string> rooms;
  Pose2 nearest;
  for (int i = 0; i < 200'000 && !follower.has_arrived(); ++i) {
    if (i % 5 == 0)
      x.command(follower.velocity_at(x.status().pose));
    x.step();
    if (x.status().clearance <= x.status().least_clearance)
      nearest = x.status().pose;
    auto* room = room_at(office, {x.status().pose.x, x.status().pose.y});
    if (room && std::find(rooms.begin(), rooms.end(), room->name) == rooms.end())
      rooms.push_back(room->name);
  }
  EXPECT_TRUE(follower.has_arrived());
  EXPECT_EQ(x.status().collisions, 0);
  EXPECT_GT(x.status().least_clearance, 0.05) << "at " << nearest.x << " " << nearest.y;
  EXPECT_GE(rooms.size(), 8u);
  EXPECT_NEAR(x.status().driven, follower.length(), 0.1 * follower.length());
}

} // namespace castor::mapping
