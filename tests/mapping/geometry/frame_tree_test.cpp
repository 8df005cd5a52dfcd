#include "castor/mapping/geometry/frame_tree.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/tests/mapping/geometry/random_poses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

namespace castor::geometry::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const FrameException& e) {
    return e.what();
  }
  return "no error";
}

/// map -> odometry -> base -> camera, and shoulder -> arm beside that.
class Frames : public testing::Test {
protected:
  void SetUp() override {
    move("odometry", "map", 1s, {});
    move("odometry", "map", 11s, {});
    move("base", "odometry", 2s, {0, 0, 0});
    move("base", "odometry", 10s, {4, 0, 0});
    fix("camera", "base", {0.1, 0, 1});
    fix("table", "map", {2, 1, 0.7}, std::numbers::pi / 2);
    fix("arm", "shoulder", {0, 0, 0.5});
  }

  void move(const std::string& frame, const std::string& in, Timestamp time,
            const Point3& position) {
    tree_.add({frame, {position, {}, in}, time.count(), false});
  }

  void fix(const std::string& frame, const std::string& in, const Point3& position,
           double turn = 0) {
    tree_.add({frame, {position, rotation_about_z(turn), in}, 0, true});
  }

  std::string refusal(const Transform& x) {
    return error_of([&] { tree_.add(x); });
  }

  std::string missing(const std::string& frame, const std::string& in,
                      std::optional<Timestamp> time = {}) const {
    return error_of([&] { tree_.pose_of(frame, in, time); });
  }

  FrameTree tree_;
};

TEST_F(Frames, ArePlacedInEachOtherAtATime) {
  const auto camera = tree_.pose_of("camera", "map", 6s);
  EXPECT_TRUE(near(camera.position, {2.1, 0, 1}));
  EXPECT_EQ(camera.frame, "map");
  // Down and sideways.
  EXPECT_TRUE(near(tree_.pose_of("map", "camera", 6s).position, {-2.1, 0, -1}));
  EXPECT_TRUE(near(tree_.pose_of("camera", "table", 6s).position, {-1, -0.1, 0.3}));
}

TEST_F(Frames, WithoutATimeAreAtTheNewestThatAllLinksKnow) {
  EXPECT_TRUE(near(tree_.pose_of("camera", "map").position, {4.1, 0, 1}));
  EXPECT_EQ(tree_.pose_of("table", "map").position, (Point3{2, 1, 0.7}));
  move("base", "odometry", 30s, {9, 0, 0});
  EXPECT_EQ(missing("camera", "map"),
            "no transform between 'map' and 'camera': that from 'odometry' to 'base' is known from "
            "30 s to 30 s, and another one until 11 s");
}

TEST_F(Frames, OfOneNameAreOne) {
  EXPECT_EQ(tree_.pose_of("map", "map", 1h), (Pose{{}, {}, "map"}));
  EXPECT_EQ(tree_.pose_of("unheard of", "unheard of"), (Pose{{}, {}, "unheard of"}));
  EXPECT_EQ(missing("", ""),
            "no transform between '' and '': a frame without a name is related to nothing");
}

TEST_F(Frames, TransformPosesAndBoxes) {
  const auto cup = tree_.transform(Pose{{0.5, 0, -0.3}, {}, "camera"}, "table", 6s);
  EXPECT_TRUE(near(cup.position, {-1, -0.6, 0}));
  EXPECT_EQ(cup.frame, "table");
  const auto box = tree_.transform(AlignedBox{{0, 0, 0}, {1, 2, 3}, "table"}, "map");
  EXPECT_TRUE(near(box.centroid, {2, 1, 0.7}));
  EXPECT_TRUE(near(box.size, {2, 1, 3}));
}

TEST_F(Frames, ThatAreNotConnectedAreNamedWithWhatIs) {
  EXPECT_EQ(missing("arm", "map"),
            "no transform between 'map' and 'arm': 'arm' is not connected; connected to 'map': "
            "base, camera, odometry, table; connected to 'arm': shoulder");
  EXPECT_EQ(missing("leg", "arm", 3s),
            "no transform between 'arm' and 'leg' at 3 s: 'leg' is not connected; connected to "
            "'arm': shoulder; connected to 'leg': nothing");
  EXPECT_THAT(tree_.connected_to("shoulder"), ElementsAre("arm"));
  EXPECT_THAT(tree_.connected_to("leg"), IsEmpty());
}

TEST_F(Frames, AreNotExtrapolated) {
  EXPECT_EQ(missing("camera", "map", 10500ms),
            "no transform between 'map' and 'camera' at 10.5 s: that from 'odometry' to 'base' is "
            "known from 2 s to 10 s");
  EXPECT_EQ(missing("map", "base", 1500ms),
            "no transform between 'base' and 'map' at 1.5 s: that from 'odometry' to 'base' is "
            "known from 2 s to 10 s");
}

TEST_F(Frames, HaveOneParent) {
  EXPECT_EQ(refusal({"base", {{}, {}, "map"}, 0, false}),
            "'base' has the parent 'odometry', so 'map' cannot be its parent too: delete the "
            "Transform from 'odometry' to 'base' before");
  tree_.remove("base");
  EXPECT_EQ(refusal({"base", {{}, {}, "map"}, 0, true}), "no error");
  // The camera is on it as before.
  EXPECT_TRUE(near(tree_.pose_of("camera", "map").position, {0.1, 0, 1}));
}

TEST_F(Frames, DoNotLieInEachOtherInACircle) {
  EXPECT_EQ(refusal({"map", {{}, {}, "camera"}, 0, false}),
            "the transform from 'camera' to 'map' would close a cycle: 'map' -> 'odometry' -> "
            "'base' -> 'camera' -> 'map'");
  EXPECT_EQ(refusal({"loop", {{}, {}, "loop"}, 0, false}),
            "the transform from 'loop' to 'loop' would close a cycle: 'loop' -> 'loop'");
  EXPECT_TRUE(near(tree_.pose_of("camera", "map").position, {4.1, 0, 1}));
}

TEST_F(Frames, AreRefusedIfTheyAreNone) {
  EXPECT_EQ(refusal({"", {{}, {}, "map"}, 0, false}),
            "the transform from 'map' to '' lacks the name of a frame: set both `frame` and "
            "`pose.frame`");
  EXPECT_EQ(refusal({"x", {}, 0, false}),
            "the transform from '' to 'x' lacks the name of a frame: set both `frame` and "
            "`pose.frame`");
  EXPECT_EQ(refusal({"x", {{}, {2, 0, 0, 0}, "map"}, 0, false}),
            "the rotation of the transform from 'map' to 'x' is no unit quaternion: its length is "
            "2. Divide it by that");
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(refusal({"x", {{bad, 0, 0}, {}, "map"}, 0, false}),
              "the transform from 'map' to 'x' has numbers that are not finite");
    EXPECT_EQ(refusal({"x", {{}, {1, bad, 0, 0}, "map"}, 0, false}),
              "the transform from 'map' to 'x' has numbers that are not finite");
  }
}

TEST_F(Frames, WithRotationsThatWereRoundedAreNormalised) {
  tree_.add({"sign", {{}, {0.7071, 0, 0, 0.7071}, "map"}, 0, true});
  const auto& q = tree_.pose_of("sign", "map").rotation;
  EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1, 1e-15);
}

TEST_F(Frames, AreForgotten) {
  tree_.remove("odometry");
  EXPECT_EQ(missing("base", "map", 5s),
            "no transform between 'map' and 'base' at 5 s: 'base' is not connected; connected to "
            "'map': table; connected to 'base': camera, odometry");
}

} // namespace

} // namespace castor::geometry::test
