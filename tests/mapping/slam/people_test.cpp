#include "castor/mapping/slam/slam.hpp"

#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <vector>

namespace castor::mapping::test {

namespace {

constexpr std::int64_t scan_period = 100'000;

/// A corridor of 30 m x 2.4 m with doors in niches, as a robot drives along it.
std::vector<Wall> corridor_with_niches() {
  std::vector<Wall> result{{{0, 0}, {0, 2.4}}, {{30, 0}, {30, 2.4}}};
  const auto side = [&](double y, double outwards, double first) {
    double from = 0;
    for (double x = first; x < 29; x += 4.3) {
      result.push_back({{from, y}, {x, y}});
      result.push_back({{x, y}, {x, y + outwards}});
      result.push_back({{x, y + outwards}, {x + 1, y + outwards}});
      result.push_back({{x + 1, y + outwards}, {x + 1, y}});
      from = x + 1;
    }
    result.push_back({{from, y}, {30, y}});
  };
  side(0, -0.3, 2);
  side(2.4, 0.3, 3.1);
  return result;
}

/// To and fro between the ends of the corridor, at a distance from its middle.
Point2 walker_at(double begin, double speed, double aside, double time) {
  constexpr double length = 28;
  const double way = std::fmod(begin + speed * time, 2 * length);
  return {1 + (way < length ? way : 2 * length - way), 1.2 + aside};
}

/// The walls, and people who do not come nearer to the robot than others do.
std::vector<Wall> scene(const std::vector<Wall>& walls, const Pose2& robot, double time) {
  auto result = walls;
  for (int i = 0; i < 6; ++i) {
    const auto place = walker_at(4.7 * i, 0.45 + 0.1 * i, i % 2 == 0 ? 0.7 : -0.7, time);
    if (distance(place, {robot.x, robot.y}) > 0.5)
      std::ranges::copy(person_at(place), std::back_inserter(result));
  }
  return result;
}

/// Drives at 0.5 m/s, and stands for 6 s after each 4 m.
std::vector<Pose2> drive() {
  std::vector<Pose2> result;
  for (int step = 0; step < 500; ++step) {
    if (step % 80 == 79)
      for (int i = 0; i < 60; ++i)
        result.push_back({1 + 0.05 * step, 1.2, 0});
    result.push_back({1 + 0.05 * step, 1.2, 0});
  }
  return result;
}

TEST(SlamAmongPeople, WhoWalkIsNotMistakenForWalls) {
  const auto walls = corridor_with_niches();
  const auto path = drive();
  const auto odometry = odometry_of(path, 0.02);
  std::mt19937 random{3};
  Slam slam;
  double worst = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto time = static_cast<double>(i) * 0.1;
    const auto scan =
      scan_from(scene(walls, path[i], time), path[i], static_cast<std::int64_t>(i) * scan_period);
    const auto step = slam.add(with_noise(scan, 0.01, random), odometry[i]);
    worst = std::max(worst, distance(in_map(path, i), step.local_pose));
  }
  EXPECT_LT(worst, 0.1);
  EXPECT_EQ(slam.dead_reckoned(), 0);
}

/// It drives 2 m in a corridor and then turns to and fro on the spot, while people walk past it.
/// @returns how far the pose is from the truth at most, m
double worst_in_passing(const SlamOptions& options) {
  std::vector<Pose2> path;
  for (int i = 0; i < 40; ++i)
    path.push_back({8 + 0.05 * i, 1.2, 0});
  for (int i = 0; i < 300; ++i)
    path.push_back({10, 1.2, 0.5 * 3.14159 * std::sin(0.06 * i)});
  const auto walls = corridor_with_niches();
  const auto odometry = odometry_of(path, 0);
  std::mt19937 random{3};
  Slam slam{options};
  double worst = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto time = static_cast<double>(i) * 0.1;
    auto seen = walls;
    for (const double begin : {1.0, 9.0, 17.0, 25.0})
      std::ranges::copy(person_at({std::fmod(begin + 0.7 * time, 29.0), 0.55}),
                        std::back_inserter(seen));
    const auto scan = scan_from(seen, path[i], static_cast<std::int64_t>(i) * scan_period);
    const auto step = slam.add(with_noise(scan, 0.01, random), odometry[i]);
    worst = std::max(worst, distance(in_map(path, i), step.local_pose));
  }
  return worst;
}

TEST(SlamAmongPeople, WhoWalksPastDoesNotTakeThePoseAlong) {
  SlamOptions without;
  without.front_end.believed_deviations = 1e9;
  without.front_end.sure_matched = 0;
  EXPECT_GT(worst_in_passing(without), 0.3) << "or it says nothing";
  EXPECT_LT(worst_in_passing({}), 0.15);
}

} // namespace

} // namespace castor::mapping::test
