// The same base in Enki, a simulator of others (GPL-2: linked into this test only). Enki calculates
// in centimetres.

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building_file.hpp"

#include <enki/PhysicalEngine.h>
#include <enki/robots/DifferentialWheeled.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace castor::mapping {

namespace {

constexpr double dt = 0.01;
constexpr double centimetres = 100;

/// A room of 6 m x 4 m, with a pillar of 0.6 m diameter at 4 2.
constexpr std::string_view room =
  "wall -0.05 -0.05 to 6.05 -0.05 to 6.05 4.05 to -0.05 4.05 close\n"
  "furniture pillar at 4 2 disc 0.6 1\n"
  "start 1 2\n";

BodyOptions obedient_body() {
  BodyOptions result;
  result.drive.slip = 0;
  result.drive.diameter_error = 0;
  // Enki's wheels have the speed that they are told.
  result.drive.acceleration = 1e6;
  result.drive.turn_acceleration = 1e6;
  return result;
}

class EnkiRobot final : public Enki::DifferentialWheeled {
public:
  EnkiRobot() : DifferentialWheeled(0.4 * centimetres, 200, 0) {
    setCylindric(0.25 * centimetres, 50, 5000);
    collisionElasticity = 0;
  }

  void collisionEvent(Enki::PhysicalObject* /*other*/) override { ++contacts; }

  int contacts = 0;
};

/// Both simulators with the same commands.
class Pair {
public:
  Pair() : world_(6 * centimetres, 4 * centimetres), body_(make_body()) {
    auto* pillar = new Enki::PhysicalObject;
    pillar->setCylindric(0.3 * centimetres, 100, -1);
    pillar->pos = Enki::Point(4 * centimetres, 2 * centimetres);
    world_.addObject(pillar);
    // The world owns what is in it.
    robot_ = new EnkiRobot;
    robot_->pos = Enki::Point(1 * centimetres, 2 * centimetres);
    robot_->angle = 0;
    world_.addObject(robot_);
  }

  void drive(const Twist2& velocity, double seconds) {
    body_.command(velocity);
    const double aside = velocity.turn * 0.4 / 2;
    robot_->leftSpeed = (velocity.forward - aside) * centimetres;
    robot_->rightSpeed = (velocity.forward + aside) * centimetres;
    for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) {
      body_.step();
      world_.step(dt, 1);
    }
  }

  BodyStatus ours() const { return body_.status(); }
  Pose2 theirs() const {
    return {robot_->pos.x / centimetres, robot_->pos.y / centimetres, normalised(robot_->angle)};
  }
  int contacts() const { return robot_->contacts; }

private:
  static SimulatedBody make_body() {
    auto read = parse_building(room, "room");
    EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
    return SimulatedBody(surroundings_in(read.building, obedient_body()), obedient_body());
  }

  Enki::World world_;
  SimulatedBody body_;
  EnkiRobot* robot_ = nullptr;
};

} // namespace

TEST(Enki, DrivesTheSameWayWhereNothingIsInTheWay) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> forward(-0.3, 0.3);
  std::uniform_real_distribution<double> turn(-1.5, 1.5);
  int compared = 0;
  for (int run = 0; run < 50; ++run) {
    Pair both;
    int commands = 0;
    for (; commands < 6 && both.contacts() == 0 && both.ours().collisions == 0; ++commands)
      both.drive({forward(random), turn(random)}, 1);
    if (both.contacts() > 0 || both.ours().collisions > 0)
      continue;
    ++compared;
    // Enki moves by the velocity of the step before, and in straight pieces.
    EXPECT_LT(distance(both.ours().pose, both.theirs()), 0.02) << run;
    EXPECT_NEAR(normalised(both.ours().pose.heading - both.theirs().heading), 0, 0.04) << run;
  }
  EXPECT_GT(compared, 30);
}

TEST(Enki, StopsAtTheSameWallAndPillar) {
  Pair wall;
  wall.drive({-0.4, 0}, 4);
  EXPECT_GT(wall.contacts(), 0);
  EXPECT_EQ(wall.ours().collisions, 1);
  EXPECT_NEAR(wall.ours().pose.x, wall.theirs().x, 0.01);
  EXPECT_NEAR(wall.theirs().x, 0.25, 0.01);
  Pair pillar;
  pillar.drive({0.4, 0}, 8);
  EXPECT_GT(pillar.contacts(), 0);
  EXPECT_EQ(pillar.ours().collisions, 1);
  EXPECT_NEAR(pillar.ours().pose.x, pillar.theirs().x, 0.01);
  EXPECT_NEAR(pillar.theirs().x, 4 - 0.3 - 0.25, 0.01);
}

} // namespace castor::mapping
