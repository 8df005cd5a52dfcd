#include "castor/mapping/geometry/transform_history.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/tests/mapping/geometry/random_poses.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <chrono>
#include <numbers>
#include <vector>

namespace castor::geometry::test {

namespace {

using namespace std::chrono_literals;

/// The robot on the x axis.
Transform at(Timestamp time, double x, double turn = 0) {
  return {"base", {{x, 0, 0}, rotation_about_z(turn), "map"}, time.count(), false};
}

class History : public testing::Test {
protected:
  void add(const Transform& x) { history_.add(x, 10s, 5); }

  TransformHistory history_;
};

TEST_F(History, InterpolatesBetweenNeighbours) {
  add(at(1s, 1));
  add(at(3s, 2, std::numbers::pi / 2));
  const auto between = history_.at(1500ms);
  ASSERT_TRUE(between);
  EXPECT_TRUE(near(between->position, {1.25, 0, 0}));
  EXPECT_TRUE(near(between->rotation, rotation_about_z(std::numbers::pi / 8)));
  EXPECT_EQ(history_.at(3s)->position, (Point3{2, 0, 0}));
}

TEST_F(History, DoesNotExtrapolate) {
  add(at(1s, 1));
  EXPECT_TRUE(history_.at(1s));
  EXPECT_FALSE(history_.at(1s - 1us));
  EXPECT_FALSE(history_.at(1s + 1us));
}

TEST_F(History, TakesPosesInAnyOrder) {
  add(at(3s, 3));
  add(at(1s, 1));
  add(at(2s, 5));
  add(at(2s, 2));
  EXPECT_TRUE(near(history_.at(1500ms)->position, {1.5, 0, 0}));
  EXPECT_TRUE(near(history_.at(2500ms)->position, {2.5, 0, 0}));
}

TEST_F(History, ForgetsWhatIsOlderThanItsLengthAndMoreThanItsCount) {
  add(at(1s, 1));
  add(at(5s, 5));
  add(at(11s, 11));
  EXPECT_EQ(history_.known().first, 1s);
  add(at(12s, 12));
  EXPECT_EQ(history_.known().first, 5s);
  for (int i = 0; i < 10; ++i)
    add(at(13s + i * 1ms, i));
  EXPECT_EQ(history_.known().first, 13s + 5ms);
  // What comes too late is not kept.
  add(at(1s, 1));
  EXPECT_EQ(history_.known().first, 13s + 5ms);
}

TEST_F(History, OfAFixedPoseHoldsAlways) {
  add(at(1s, 1));
  auto fixed = at(5s, 7);
  fixed.is_fixed = true;
  add(fixed);
  EXPECT_TRUE(history_.is_fixed());
  EXPECT_EQ(history_.at(0s)->position.x, 7);
  EXPECT_EQ(history_.at(1h)->position.x, 7);
  fixed.pose.position.x = 8;
  fixed.time = 0;
  add(fixed);
  EXPECT_EQ(history_.at(6s)->position.x, 8);
  add(at(2s, 2));
  EXPECT_FALSE(history_.at(6s));
}

TEST(HistoryProperties, IsLinearBetweenPosesWhateverTheirOrder) {
  EXPECT_TRUE(rc::check([](std::vector<std::uint8_t> times) {
    RC_PRE(!times.empty());
    TransformHistory history;
    for (const auto x : times)
      history.add(at(Timestamp{1000 * x}, x), 10s, 1000);
    const auto [from, to] = history.known();
    RC_ASSERT(from == Timestamp{1000 * *std::ranges::min_element(times)});
    RC_ASSERT(to == Timestamp{1000 * *std::ranges::max_element(times)});
    const Timestamp time{*rc::gen::inRange<std::int64_t>(0, 256'000)};
    const auto pose = history.at(time);
    RC_ASSERT(pose.has_value() == (from <= time && time <= to));
    if (pose)
      RC_ASSERT(std::abs(pose->position.x - static_cast<double>(time.count()) / 1000) < 1e-9);
  }));
}

} // namespace

} // namespace castor::geometry::test
