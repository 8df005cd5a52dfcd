#include "castor/mapping/slam/loop_closer.hpp"

#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace castor::mapping::test {

namespace {

/// Keyframes around the block in the room, one and a quarter times, with local poses that drift.
class LoopCloserTest : public ::testing::Test {
protected:
  void make(double drift, double scale = 1.0) {
    std::mt19937 random{11};
    auto path = path_around(1.25);
    Pose2 drifting = path[0];
    for (std::size_t i = 0; i < path.size(); i += 4) {
      if (i > 0) {
        auto step = between(path[i - 4], path[i]);
        step.x *= scale;
        step.heading += drift * std::hypot(step.x, step.y);
        drifting = compose(drifting, step);
      }
      Keyframe x;
      x.number = static_cast<std::int64_t>(keyframes.size());
      x.time = static_cast<std::int64_t>(i) * 100000;
      x.local_pose = drifting;
      x.scan = with_noise(scan_from(walls, path[i], x.time), 0.01, random);
      keyframes.push_back(x);
      truth.push_back(path[i]);
      poses.push_back(drifting);
    }
  }

  std::vector<Constraint> close_all() {
    std::vector<Constraint> result;
    for (std::size_t i = 0; i < keyframes.size(); ++i)
      for (auto& x : closer.add(
             keyframes[i], {poses.begin(), poses.begin() + 1 + static_cast<std::ptrdiff_t>(i)}))
        result.push_back(x);
    return result;
  }

  double error_of(const Constraint& x) const {
    return distance(x.pose, between(truth[static_cast<std::size_t>(x.from)],
                                    truth[static_cast<std::size_t>(x.to)]));
  }

  std::vector<Wall> walls = furnished_room();
  std::vector<Keyframe> keyframes;
  std::vector<Pose2> truth;
  std::vector<Pose2> poses;
  LoopCloser closer;
};

TEST_F(LoopCloserTest, NoticesThatTheRobotComesBack) {
  make(0.003);
  auto loops = close_all();
  ASSERT_GT(loops.size(), 5U);
  for (const auto& x : loops) {
    EXPECT_EQ(x.kind, ConstraintKind::loop);
    EXPECT_LT(x.from, x.to);
    // Both ends see the same; the path between them goes around the block.
    EXPECT_LT(error_of(x), 0.04) << x.from << " " << x.to;
  }
}

TEST_F(LoopCloserTest, CorrectsADriftOfMoreThanAMetre) {
  make(0.02);
  auto last = truth.size() - 1;
  EXPECT_GT(distance(between(poses[0], poses[last]), between(truth[0], truth[last])), 0.6);
  auto loops = close_all();
  ASSERT_GT(loops.size(), 1U);
  for (const auto& x : loops)
    EXPECT_LT(error_of(x), 0.05) << x.from << " " << x.to;
}

TEST_F(LoopCloserTest, OneClosureIsNotEnoughForALargeCorrection) {
  make(0.02);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    auto loops =
      closer.add(keyframes[i], {poses.begin(), poses.begin() + 1 + static_cast<std::ptrdiff_t>(i)});
    if (loops.empty())
      continue;
    // The first ones come together, from different places of the way.
    ASSERT_GE(loops.size(), 2U);
    EXPECT_NE(loops[0].to, loops[1].to);
    return;
  }
  FAIL() << "no loop was closed";
}

TEST_F(LoopCloserTest, ACorridorClosesNoLoop) {
  // There and back again, which looks the same everywhere.
  walls = endless_corridor();
  for (int i = 0; i < 80; ++i) {
    Keyframe x;
    x.number = i;
    x.local_pose = {i < 40 ? 0.2 * i : 0.2 * (80 - i), 0, 0};
    x.scan = scan_from(walls, x.local_pose);
    keyframes.push_back(x);
    poses.push_back(x.local_pose);
  }
  EXPECT_TRUE(close_all().empty());
}

TEST_F(LoopCloserTest, OnTheWayOutThereIsNoLoop) {
  make(0.003);
  keyframes.resize(keyframes.size() / 3);
  EXPECT_TRUE(close_all().empty());
}

TEST_F(LoopCloserTest, ANewOneRemembersWhatAnotherHasFound) {
  make(0.003);
  auto loops = close_all();
  auto half = loops[loops.size() / 2].to;
  closer = LoopCloser{};
  for (std::int64_t i = 0; i <= half; ++i)
    closer.remember(keyframes[static_cast<std::size_t>(i)]);
  std::size_t after = 0;
  for (const auto& x : loops)
    if (x.to <= half)
      closer.remember(x);
    else
      ++after;
  std::size_t found = 0;
  for (auto i = static_cast<std::size_t>(half) + 1; i < keyframes.size(); ++i)
    found += closer.add(keyframes[i], poses).size();
  EXPECT_NEAR(static_cast<double>(found), static_cast<double>(after), 2);
}

TEST_F(LoopCloserTest, KeyframesComeInOrder) {
  make(0.003);
  EXPECT_THROW(closer.remember(keyframes[1]), std::invalid_argument);
  EXPECT_THROW(closer.add(keyframes[0], {}), std::invalid_argument);
  LoopCloser other;
  other.remember(keyframes[0]);
  EXPECT_THROW(other.remember(Constraint{0, 7, ConstraintKind::loop, {}, {}}), std::out_of_range);
}

} // namespace

} // namespace castor::mapping::test
