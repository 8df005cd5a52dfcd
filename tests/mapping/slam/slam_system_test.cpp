// SLAM as components of a system that fail and come back, in simulated time.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/tests/mapping/slam/simulated_room.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

using namespace std::chrono_literals;

/// Two rounds around the block in the room.
const std::vector<Pose2>& route() {
  static const auto result = path_around(1.5);
  return result;
}

/// Pushes odometry and a scan at each step of the route.
class RouteRobot final : public StandaloneComponent {
  void run() override {
    auto walls = furnished_room();
    auto odometry = odometry_of(route(), 0.03);
    std::mt19937 random{4};
    for (std::size_t i = 0; i < route().size() && sleep_for(100ms); ++i) {
      auto time = now().count();
      auto scan = with_noise(scan_from(walls, route()[i], time), 0.01, random);
      if (static_cast<int>(i) < blind_after_)
        push(scan);
      push(Odometry{time, odometry[i], {}});
    }
    while (sleep_for(1s)) {
      // It stands at the end of its route.
    }
  }

  Option<int> blind_after_{this, "blind-after", 1000000, "scans after which there are no more"};
};
CASTOR_COMPONENT(RouteRobot, "for tests: drives around a room")

class SlamSystem : public ::testing::Test {
protected:
  static std::string cast(const std::string& robot_options = {}) {
    return "COMPONENT CPP robot RouteRobot " + robot_options +
           "\n"
           "SUBARCHITECTURE slam\n"
           "CPP WM SubarchitectureWorkingMemory\n"
           "CPP TM AlwaysPositiveTaskManager\n"
           "CPP UM front-end ScanMatchingFrontEnd\n"
           "CPP UM loops LoopCloser\n"
           "CPP UM graph PoseGraphOptimiser\n";
  }

  static TestSystemOptions simulated() {
    TestSystemOptions result;
    result.simulated_time = true;
    result.patience = 300s;
    return result;
  }

  template <class T>
  static std::vector<T> all(TestSystem& system) {
    std::vector<T> result;
    for (auto& entry : system.system().entries("slam"))
      if (auto x = entry->value.as<T>())
        result.push_back(*x);
    return result;
  }

  static std::size_t keyframes(TestSystem& system) { return all<Keyframe>(system).size(); }

  static double error_at_end(const RobotPose& x) {
    return distance(in_map(route(), route().size() - 1), x.pose);
  }

  /// Waits until the robot stands at the end of its route, and all that it has seen was processed.
  static RobotPose wait_for_end(TestSystem& system) {
    auto end = std::chrono::microseconds{static_cast<std::int64_t>(route().size()) * 100000};
    system.wait_until("the end of the route", [&] {
      return !all<RobotPose>(system).empty() && system.system().now() > end + 5s;
    });
    return all<RobotPose>(system).at(0);
  }

  /// Keyframes from 0 without gaps, each with its step.
  static void expect_whole_path(TestSystem& system) {
    auto frames = all<Keyframe>(system);
    std::sort(frames.begin(), frames.end(),
              [](const Keyframe& a, const Keyframe& b) { return a.number < b.number; });
    for (std::size_t i = 0; i < frames.size(); ++i)
      ASSERT_EQ(frames[i].number, static_cast<std::int64_t>(i));
    std::vector<int> steps(frames.size());
    for (auto& x : all<Constraint>(system))
      if (x.kind != ConstraintKind::loop)
        ++steps.at(static_cast<std::size_t>(x.to));
    for (std::size_t i = 1; i < steps.size(); ++i)
      EXPECT_EQ(steps[i], 1) << i;
  }

  static void expect_good_map(TestSystem& system) {
    auto graph = all<GraphPoses>(system);
    ASSERT_EQ(graph.size(), 1U);
    EXPECT_GT(graph[0].loops, 3);
    EXPECT_EQ(graph[0].doubted_loops, 0);
    auto frames = all<Keyframe>(system);
    for (auto& x : frames) {
      auto i = static_cast<std::size_t>(x.time / 100000) - 1;
      auto number = static_cast<std::size_t>(x.number);
      if (number < graph[0].poses.size()) {
        EXPECT_LT(distance(in_map(route(), i), graph[0].poses[number]), 0.1)
          << number;
      }
    }
  }
};

} // namespace

TEST_F(SlamSystem, MapsWhatTheRobotSees) {
  TestSystem system{cast(), simulated()};
  auto pose = wait_for_end(system);
  EXPECT_LT(error_at_end(pose), 0.05);
  EXPECT_EQ(pose.frame, "map");
  EXPECT_GT(keyframes(system), 150U);
  expect_whole_path(system);
  expect_good_map(system);
  EXPECT_EQ(all<RobotPose>(system).size(), 1U);
  // The frame of the odometry is where it has the robot in the right place.
  auto frames = all<geometry::Transform>(system);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].frame, "odometry");
  EXPECT_EQ(frames[0].pose.frame, "map");
  system.expect_nobody_else_down();
}

TEST_F(SlamSystem, AFrontEndThatFailsGoesOnFromTheKeyframes) {
  TestSystem system{cast(), simulated()};
  for (std::size_t count : {40, 90}) {
    system.wait_until("keyframes", [&] { return keyframes(system) >= count; });
    system.inject("crash front-end");
    system.expect_down("front-end");
  }
  system.expect_back("front-end", 3);
  auto pose = wait_for_end(system);
  EXPECT_LT(error_at_end(pose), 0.05);
  expect_whole_path(system);
  expect_good_map(system);
}

TEST_F(SlamSystem, LoopCloserAndGraphThatFailGoOn) {
  TestSystem system{cast(), simulated()};
  system.wait_until("keyframes", [&] { return keyframes(system) >= 60; });
  system.inject("crash graph");
  system.expect_back("graph");
  system.wait_until("loops", [&] {
    auto graph = all<GraphPoses>(system);
    return !graph.empty() && graph[0].loops >= 2;
  });
  auto version = all<GraphPoses>(system).at(0).version;
  system.inject("crash graph");
  system.inject("crash loops");
  system.expect_back("graph", 3);
  system.expect_back("loops");
  auto pose = wait_for_end(system);
  EXPECT_LT(error_at_end(pose), 0.05);
  EXPECT_GT(all<GraphPoses>(system).at(0).version, version);
  expect_whole_path(system);
  expect_good_map(system);
}

TEST_F(SlamSystem, ALaserThatStopsIsSaid) {
  TestSystem system{cast("--blind-after 60"), simulated()};
  system.wait_until("silence", [&] {
    auto poses = all<RobotPose>(system);
    return !poses.empty() && poses[0].state == LocalisationState::dead_reckoning;
  });
  auto pose = all<RobotPose>(system).at(0);
  EXPECT_NE(pose.reason.find("no scan comes from robot"), std::string::npos) << pose.reason;
  // The wheels still move it.
  system.wait_until("movement",
                    [&] { return distance(all<RobotPose>(system).at(0).pose, pose.pose) > 0.5; });
  EXPECT_GT(all<RobotPose>(system).at(0).covariance.xx, pose.covariance.xx);
}

} // namespace castor::mapping::test
