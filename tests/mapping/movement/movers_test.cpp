#include "castor/mapping/movement/movers.hpp"

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/movement/mover_watch.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace castor::mapping {

namespace {

double share(const std::vector<Mover>& movers, const Twist2& wanted = {0.5, 0}) {
  return share_among_movers({}, wanted, movers, {});
}

TEST(Movers, NobodyIsNoReasonToBeSlow) {
  EXPECT_EQ(share({}), 1);
  EXPECT_EQ(share({{{5, 3}, {0.5, 0}}}), 1) << "far away";
  EXPECT_EQ(share({{{0.8, 0}, {-1, 0}}}, {0, 1}), 1) << "the robot may turn";
}

TEST(Movers, StopsBeforeSomebodyWhoComesTowardsIt) {
  EXPECT_EQ(share({{{1.5, 0}, {-1, 0}}}), 0);
}

TEST(Movers, BrakesForSomebodyWhoCrossesItsWay) {
  // Both would be at 1 0 after two seconds.
  EXPECT_LT(share({{{1, -1.6}, {0, 0.8}}}), 0.5);
  EXPECT_EQ(share({{{1, 1.6}, {0, 0.8}}}), 1) << "goes away";
}

TEST(Movers, IsSlowNearSomebodyWhoStands) {
  EXPECT_NEAR(share({{{0.5, 1}, {0, 0}}}) * 0.5, MoverOptions{}.near_speed, 1e-9);
}

TEST(Movers, IsNotSlowNearSomebodyWhoHasPassed) {
  EXPECT_EQ(share({{{-0.3, 0.9}, {-0.8, 0}}}), 1);
}

TEST(Movers, DrivesAwayFromSomebodyBehindIt) {
  EXPECT_GT(share({{{-0.7, 0}, {0.4, 0}}}), 0);
}

RC_GTEST_PROP(Movers, NeverLetsSomebodyComeNearerSoonerThanARobotThatStands, ()) {
  const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) * 0.01; };
  const Mover x{{number(-300, 300), number(-300, 300)}, {number(-120, 120), number(-120, 120)}};
  const Twist2 wanted{number(1, 60), number(-100, 100)};
  const MoverOptions options;
  RC_PRE(x.speed() >= options.least_speed);
  const double part = share_among_movers({}, wanted, std::vector{x}, options);
  RC_ASSERT(part >= 0 && part <= 1);
  const double kept = options.robot_radius + options.mover_radius + options.gap;
  for (double t = 0.1; t <= options.horizon; t += 0.1) {
    const auto robot = moved({}, {part * wanted.forward, part * wanted.turn}, t);
    const Point2 there{x.place.x + t * x.velocity.x, x.place.y + t * x.velocity.y};
    const double away = distance(there, {robot.x, robot.y});
    RC_ASSERT(away >= std::min(kept, distance(there, Point2{})) - 1e-3);
  }
}

TEST(MoverWatch, SeesWhoWalksInTheFrameOfTheRobotsPose) {
  const auto building = parse_building("wall 0 0 to 10 0 to 10 8 to 0 8 close\n"
                                       "person ann route 5 2 to 5 7 speed 0.8\n"
                                       "start 2 4\n",
                                       "")
                          .building;
  BodyOptions options;
  options.people = true;
  SimulatedBody body{surroundings_in(building, options), options};
  MoverWatch watch;
  // The robot's map is shifted.
  const auto pose = [&] {
    auto result = body.status().pose;
    result.x += 100;
    return result;
  };
  EXPECT_TRUE(watch.movers(pose()).empty());
  while (body.time() < std::chrono::seconds{4}) {
    body.step();
    watch.add(body.odometry());
    if (body.steps() % 10 == 0)
      watch.add(body.scan());
  }
  const auto movers = watch.movers(pose());
  ASSERT_EQ(movers.size(), 1u);
  const auto ann = body.people().discs()[0].centre;
  EXPECT_NEAR(movers[0].place.x, ann.x + 100, 0.25);
  EXPECT_NEAR(movers[0].place.y, ann.y, 0.25);
  EXPECT_NEAR(movers[0].velocity.x, 0, 0.25);
  EXPECT_NEAR(movers[0].velocity.y, 0.8, 0.25);
}

} // namespace

} // namespace castor::mapping
