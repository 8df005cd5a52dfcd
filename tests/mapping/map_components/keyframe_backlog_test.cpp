#include "castor/mapping/map_components/keyframe_backlog.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

EntryOf<Keyframe> keyframe(std::int64_t number) {
  auto x = std::make_shared<Keyframe>();
  x->number = number;
  x->local_pose = {static_cast<double>(number), 0, 0};
  return {{"slam", "keyframe " + std::to_string(number)}, 1, "front-end", x};
}

std::shared_ptr<const GraphPoses> poses(const std::vector<double>& x) {
  auto result = std::make_shared<GraphPoses>();
  for (auto value : x)
    result->poses.push_back({value, 0, 0});
  return result;
}

/// Numbers of the rest of a pass.
std::vector<std::int64_t> rest(KeyframeBacklog& backlog) {
  std::vector<std::int64_t> result;
  while (auto x = backlog.take())
    result.push_back(x->keyframe->number);
  return result;
}

using Numbers = std::vector<std::int64_t>;

TEST(KeyframeBacklog, TellsByIncreasingNumbers) {
  KeyframeBacklog backlog;
  EXPECT_FALSE(backlog.has_next());
  EXPECT_EQ(backlog.newest(), -1);
  for (auto number : {4, 1, 2, 1})
    backlog.add(keyframe(number));
  EXPECT_EQ(backlog.newest(), 4);
  EXPECT_EQ(rest(backlog), (Numbers{1, 2, 4}));
  EXPECT_FALSE(backlog.begin_pass());
  backlog.add(keyframe(2));
  EXPECT_FALSE(backlog.has_next());
}

TEST(KeyframeBacklog, TellsOnlyOfPosesThatWereCorrected) {
  KeyframeBacklog backlog;
  backlog.correct(poses({0, 1.5}));
  for (auto number : {0, 1, 2})
    backlog.add(keyframe(number));
  EXPECT_EQ(backlog.take()->robot.x, 0);
  EXPECT_EQ(backlog.take()->robot.x, 1.5);
  // Not in the graph yet.
  EXPECT_EQ(backlog.take()->robot.x, 2);
  backlog.begin_pass();
  backlog.correct(poses({0.00005, 1.5, 2.5}));
  EXPECT_EQ(rest(backlog), (Numbers{2}));
  // Small corrections add up.
  backlog.begin_pass();
  backlog.correct(poses({0.00012, 1.5, 2.5}));
  EXPECT_EQ(rest(backlog), (Numbers{0}));
}

TEST(KeyframeBacklog, NewKeyframesJoinThePass) {
  KeyframeBacklog backlog;
  for (auto number : {0, 1})
    backlog.add(keyframe(number));
  backlog.take();
  backlog.add(keyframe(2));
  EXPECT_EQ(rest(backlog), (Numbers{1, 2}));
  EXPECT_FALSE(backlog.begin_pass());
}

TEST(KeyframeBacklog, WhatIsCorrectedAfterItWasToldBelongsToTheNextPass) {
  KeyframeBacklog backlog;
  for (auto number : {0, 1, 2})
    backlog.add(keyframe(number));
  backlog.take();
  backlog.correct(poses({0.5, 1.5, 2.5}));
  // At the newest pose.
  EXPECT_EQ(backlog.take()->robot.x, 1.5);
  EXPECT_EQ(rest(backlog), (Numbers{2}));
  EXPECT_TRUE(backlog.begin_pass());
  EXPECT_EQ(backlog.take()->robot.x, 0.5);
  EXPECT_FALSE(backlog.has_next());
}

TEST(KeyframeBacklog, APassEndsHoweverOftenPosesAreCorrected) {
  KeyframeBacklog backlog;
  for (auto number : {0, 1, 2, 3})
    backlog.add(keyframe(number));
  int told = 0;
  for (int i = 1; backlog.has_next(); ++i) {
    backlog.take();
    ++told;
    backlog.correct(poses({0.1 * i, 1 + 0.1 * i, 2 + 0.1 * i, 3 + 0.1 * i}));
  }
  EXPECT_EQ(told, 4);
  EXPECT_TRUE(backlog.begin_pass());
  EXPECT_EQ(rest(backlog), (Numbers{0, 1, 2, 3}));
}

TEST(KeyframeBacklog, ForgetsDeletedKeyframes) {
  KeyframeBacklog backlog;
  for (auto number : {0, 1, 2})
    backlog.add(keyframe(number));
  backlog.take();
  EXPECT_TRUE(backlog.remove("keyframe 0"));
  EXPECT_FALSE(backlog.remove("keyframe 0"));
  EXPECT_FALSE(backlog.remove("nobody"));
  // The follower has never heard of it.
  EXPECT_FALSE(backlog.remove("keyframe 1"));
  EXPECT_EQ(rest(backlog), (Numbers{2}));
}

} // namespace

} // namespace castor::mapping::test
