// The pose graph, and when it is computed.

#include "castor/mapping/slam/graph_updater.hpp"
#include "castor/mapping/slam/pose_graph.hpp"
#include "castor/mapping/slam/slam.hpp"
#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace castor::mapping::test {

namespace {

using std::numbers::pi;

constexpr PoseCovariance precise{1e-4, 0, 0, 1e-4, 0, 1e-5};

/// Rounds of a square of 5 m, one pose each metre; each step turns a little too far.
struct Square {
  explicit Square(int rounds) {
    Pose2 drifting{1, 2, 0.5};
    Pose2 pose = drifting;
    for (int i = 0; i < 20 * rounds; ++i) {
      truth.push_back(pose);
      drifted.push_back(drifting);
      Pose2 step{1, 0, i % 5 == 4 ? pi / 2 : 0};
      pose = compose(pose, step);
      step.heading += 0.005;
      step.x *= 1.005;
      drifting = compose(drifting, step);
      steps.push_back({i, i + 1, ConstraintKind::motion, step, {1e-3, 0, 0, 1e-3, 0, 1e-4}});
    }
    steps.pop_back();
  }

  Constraint loop(int from, int to) const {
    return {from, to, ConstraintKind::loop,
            between(truth[static_cast<std::size_t>(from)], truth[static_cast<std::size_t>(to)]),
            precise};
  }

  double worst(const std::vector<Pose2>& poses) const {
    double result = 0;
    for (std::size_t i = 0; i < poses.size(); ++i)
      result = std::max(result, distance(poses[i], truth[i]));
    return result;
  }

  std::vector<Pose2> truth;
  std::vector<Pose2> drifted;
  std::vector<Constraint> steps;
};

PoseGraph graph_of(const Square& square) {
  PoseGraph result;
  result.add_pose(square.truth[0]);
  for (const auto& x : square.steps)
    result.add_pose(x);
  return result;
}

TEST(PoseGraph, WithoutLoopsThePathStays) {
  Square square{2};
  auto graph = graph_of(square);
  EXPECT_TRUE(graph.solve());
  for (std::size_t i = 0; i < square.drifted.size(); ++i)
    EXPECT_LT(distance(graph.pose(static_cast<std::int64_t>(i)), square.drifted[i]), 1e-6);
}

TEST(PoseGraph, LoopsCorrectThePath) {
  Square square{2};
  auto graph = graph_of(square);
  EXPECT_GT(square.worst(graph.poses()), 0.5);
  for (int i = 0; i < 20; i += 2)
    graph.add(square.loop(i, i + 20));
  graph.add(square.loop(0, 19));
  EXPECT_TRUE(graph.solve());
  EXPECT_EQ(graph.pose(0), square.truth[0]);
  EXPECT_LT(square.worst(graph.poses()), 0.25);
  EXPECT_EQ(graph.loops(), 11U);
  EXPECT_EQ(graph.doubted_loops(), 0U);
}

TEST(PoseGraph, AWrongLoopIsOutvoted) {
  Square square{2};
  auto graph = graph_of(square);
  for (int i = 0; i < 20; ++i)
    graph.add(square.loop(i, i + 20));
  EXPECT_TRUE(graph.solve());
  auto before = graph.poses();
  // The opposite corner of the square is taken for this one.
  graph.add({3, 33, ConstraintKind::loop, {0, 0, 1}, precise});
  EXPECT_TRUE(graph.solve());
  double moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    moved = std::max(moved, distance(graph.pose(static_cast<std::int64_t>(i)), before[i]));
  EXPECT_LT(moved, 0.05);
  EXPECT_EQ(graph.doubted_loops(), 1U);
}

TEST(PoseGraph, TheHeadingMayTurnMoreThanOnce) {
  PoseGraph graph;
  graph.add_pose(Pose2{});
  for (int i = 0; i < 40; ++i)
    graph.add_pose({i, i + 1, ConstraintKind::motion, {0, 0, 1}, precise});
  graph.add({0, 40, ConstraintKind::loop, {0, 0, normalised(40.02)}, precise});
  EXPECT_TRUE(graph.solve());
  EXPECT_NEAR(normalised(graph.pose(40).heading - 40.02), 0, 0.01);
}

TEST(PoseGraph, TheCovarianceGrowsAlongThePath) {
  Square square{1};
  auto graph = graph_of(square);
  graph.solve();
  EXPECT_EQ(graph.covariance(0), PoseCovariance{});
  EXPECT_NEAR(graph.covariance(1).heading, 1e-4, 1e-6);
  EXPECT_NEAR(graph.covariance(10).heading, 1e-3, 1e-5);
  EXPECT_GT(graph.covariance(10).xx, graph.covariance(5).xx);
}

TEST(PoseGraph, RefusesWhatIsNoConstraint) {
  PoseGraph graph;
  graph.add_pose(Pose2{});
  EXPECT_THROW(graph.add_pose({0, 2, ConstraintKind::motion, {}, precise}), std::out_of_range);
  EXPECT_THROW(graph.add_pose({0, 1, ConstraintKind::motion, {}, {}}), std::invalid_argument);
  EXPECT_EQ(graph.size(), 1U);
  graph.add_pose({0, 1, ConstraintKind::motion, {1, 0, 0}, precise});
  EXPECT_THROW(graph.add({0, 7, ConstraintKind::loop, {}, precise}), std::out_of_range);
  EXPECT_THROW(graph.add({1, 1, ConstraintKind::loop, {}, precise}), std::invalid_argument);
  EXPECT_THROW(graph.pose(-1), std::out_of_range);
}

class Updates : public ::testing::Test {
protected:
  Keyframe keyframe(std::size_t i) const {
    Keyframe x;
    x.number = static_cast<std::int64_t>(i);
    x.time = 1000 * x.number;
    x.local_pose = square.drifted[i];
    return x;
  }

  void add_all(GraphUpdater& updater) const {
    for (std::size_t i = 0; i < square.truth.size(); ++i) {
      updater.add(keyframe(i));
      if (i > 0)
        updater.add(square.steps[i - 1]);
    }
  }

  Square square{2};
};

TEST_F(Updates, TheOrderOfEntriesDoesNotMatter) {
  GraphUpdater straight;
  add_all(straight);
  straight.add(square.loop(0, 20));
  straight.add(square.loop(5, 25));
  auto wanted = straight.solve();
  ASSERT_EQ(wanted.poses.size(), 40U);
  std::mt19937 random{1};
  for (int run = 0; run < 5; ++run) {
    std::vector<int> order;
    for (int i = 0; i < 200; ++i)
      order.push_back(i % 81); // some twice
    std::shuffle(order.begin(), order.end(), random);
    GraphUpdater updater;
    std::vector<bool> seen(81);
    auto add = [&](int i) {
      seen[static_cast<std::size_t>(i)] = true;
      if (i < 40)
        updater.add(keyframe(static_cast<std::size_t>(i)));
      else if (i < 79)
        updater.add(square.steps[static_cast<std::size_t>(i - 40)]);
      else
        updater.add(i == 79 ? square.loop(0, 20) : square.loop(5, 25));
    };
    for (auto i : order)
      add(i);
    for (int i = 0; i < 81; ++i)
      EXPECT_TRUE(seen[static_cast<std::size_t>(i)]);
    auto got = updater.solve();
    ASSERT_EQ(got.poses.size(), 40U);
    EXPECT_EQ(got.loops, 2);
    for (std::size_t i = 0; i < 40; ++i)
      EXPECT_LT(distance(got.poses[i], wanted.poses[i]), 1e-3);
  }
}

TEST_F(Updates, AreDueWithNewLoops) {
  GraphUpdater updater;
  EXPECT_FALSE(updater.is_due());
  add_all(updater);
  // Others want to know that there is a map at all.
  EXPECT_TRUE(updater.is_due());
  EXPECT_EQ(updater.solve().version, 1);
  EXPECT_FALSE(updater.is_due());
  updater.add(square.loop(0, 20));
  EXPECT_TRUE(updater.is_due());
  EXPECT_EQ(updater.solve().version, 2);
  EXPECT_FALSE(updater.is_due());
}

TEST_F(Updates, SmallCorrectionsWaitForKeyframes) {
  GraphUpdater updater;
  updater.add(keyframe(0));
  auto add = [&](std::size_t i) {
    updater.add(keyframe(i));
    updater.add(square.steps[i - 1]);
  };
  for (std::size_t i = 1; i < 25; ++i)
    add(i);
  updater.solve();
  auto small = updater.graph().poses();
  updater.add({0, 20, ConstraintKind::loop, between(small[0], small[20]), precise});
  EXPECT_FALSE(updater.is_due());
  for (std::size_t i = 25; i < 35; ++i)
    add(i);
  EXPECT_TRUE(updater.is_due());
}

TEST_F(Updates, TheLocalFrameIsThatOfTheNewestKeyframe) {
  GraphUpdater updater;
  add_all(updater);
  for (int i = 0; i < 20; ++i)
    updater.add(square.loop(i, i + 20));
  auto poses = updater.solve();
  EXPECT_EQ(poses.time, 39000);
  auto newest = compose(poses.local_frame, square.drifted.back());
  EXPECT_LT(distance(newest, poses.poses.back()), 1e-9);
  // Keyframes that the graph does not have yet follow from it.
  auto local = square.drifted;
  local.push_back(compose(local.back(), {1, 0, 0}));
  auto all = keyframe_poses(poses, local);
  ASSERT_EQ(all.size(), 41U);
  EXPECT_LT(distance(all[40], compose(poses.poses.back(), {1, 0, 0})), 1e-9);
}

TEST_F(Updates, ANewOneGoesOnFromTheLastPoses) {
  GraphUpdater first;
  add_all(first);
  for (int i = 0; i < 20; ++i)
    first.add(square.loop(i, i + 20));
  auto poses = first.solve();
  GraphUpdater second;
  add_all(second);
  second.restore(poses);
  for (std::size_t i = 0; i < 40; ++i)
    EXPECT_EQ(second.graph().pose(static_cast<std::int64_t>(i)).x, poses.poses[i].x);
  EXPECT_EQ(second.solve().version, 2);
}

TEST(Slam, ClosesTheLoopAroundABlock) {
  auto walls = furnished_room();
  auto path = path_around(2);
  auto odometry = odometry_of(path, 0.05);
  std::mt19937 random{9};
  Slam slam;
  for (std::size_t i = 0; i < path.size(); ++i)
    slam.add(
      with_noise(scan_from(walls, path[i], static_cast<std::int64_t>(i) * 100000), 0.01, random),
      odometry[i]);
  slam.finish();
  EXPECT_GT(slam.graph().loops(), 10U);
  EXPECT_EQ(slam.dead_reckoned(), 0U);
  auto found = slam.path();
  ASSERT_EQ(found.size(), path.size());
  double worst = 0;
  for (std::size_t i = 0; i < path.size(); ++i)
    worst = std::max(worst, distance(in_map(path, i), found[i].pose));
  EXPECT_LT(worst, 0.05);
}

} // namespace

} // namespace castor::mapping::test
