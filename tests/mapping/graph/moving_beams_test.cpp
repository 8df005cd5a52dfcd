#include "castor/mapping/graph/moving_beams.hpp"

#include "castor/tests/mapping/graph/two_rooms.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace castor::mapping::test {

namespace {

TEST(MovingBeams, AreThoseThatHitSomebodyWhoWalks) {
  Scanner scanner(two_rooms());
  MovingBeams beams;
  std::vector<bool> moving;
  LaserScan last;
  std::vector<Disc> people;
  for (int i = 0; i < 8; ++i) {
    // The robot drives on meanwhile.
    const Pose2 robot{1 + 0.1 * i, 2.5, 0};
    people = {{{3.5, 1 + 0.25 * i}, 0.25}};
    last = scanner.scan(robot, people, i * 300'000);
    moving = beams.add(std::make_shared<const LaserScan>(last), robot);
  }
  const Pose2 laser = compose({1.7, 2.5, 0}, last.mount);
  int hits_person = 0;
  int found = 0;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const auto angle = last.first_angle + static_cast<double>(i) * last.angle_step;
    const auto end =
      transform(laser, {last.ranges[i] * std::cos(angle), last.ranges[i] * std::sin(angle)});
    const bool is_person = distance(end, people[0].centre) < 0.3;
    hits_person += is_person;
    found += is_person && moving[i];
    EXPECT_TRUE(is_person || !moving[i]) << "beam " << i << " hit a wall";
  }
  EXPECT_GT(hits_person, 8);
  EXPECT_GE(found, hits_person - 2);
}

TEST(MovingBeams, AreNotThoseOfScansLongAgo) {
  Scanner scanner(two_rooms());
  MovingBeams beams;
  const Pose2 robot{1, 2.5, 0};
  for (int i = 0; i < 3; ++i)
    beams.add(std::make_shared<const LaserScan>(scanner.scan(robot, {}, i * 300'000)), robot);
  const auto later = scanner.scan(robot, {{{3.5, 2.5}, 0.25}}, 60'000'000);
  const auto moving = beams.add(std::make_shared<const LaserScan>(later), robot);
  EXPECT_EQ(std::ranges::count(moving, true), 0);
}

} // namespace

} // namespace castor::mapping::test
