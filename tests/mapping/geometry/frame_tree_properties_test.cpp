#include "castor/mapping/geometry/frame_tree.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/tests/mapping/geometry/random_poses.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace castor::geometry::test {

namespace {

/// A tree whose poses in its root are known: each frame lies in one of those before it.
struct KnownTree {
  KnownTree() {
    const auto count = *rc::gen::inRange<std::size_t>(1, 9);
    for (std::size_t i = 0; i < count; ++i) {
      const auto name = "frame " + std::to_string(i);
      if (i == 0) {
        in_root.emplace(name, Pose{{}, {}, name});
        names.push_back(name);
        continue;
      }
      const auto parent = names[*rc::gen::inRange<std::size_t>(0, names.size())];
      const Transform link{name, any_pose(parent), 0, true};
      tree.add(link);
      in_root.emplace(name, compose(in_root.at(parent), link.pose));
      names.push_back(name);
    }
  }

  const std::string& any_frame() const {
    return names[*rc::gen::inRange<std::size_t>(0, names.size())];
  }

  FrameTree tree;
  std::vector<std::string> names;
  /// Composed directly.
  std::map<std::string, Pose> in_root;
};

TEST(FrameTreeProperties, PosesAreThoseOfDirectComposition) {
  EXPECT_TRUE(rc::check([] {
    const KnownTree known;
    const auto& a = known.any_frame();
    const auto& b = known.any_frame();
    const auto expected = compose(inverse(known.in_root.at(b), b), known.in_root.at(a));
    RC_ASSERT(near(known.tree.pose_of(a, b), expected, 1e-8));
  }));
}

TEST(FrameTreeProperties, TheWayBackIsTheInverse) {
  EXPECT_TRUE(rc::check([] {
    const KnownTree known;
    const auto& a = known.any_frame();
    const auto& b = known.any_frame();
    RC_ASSERT(near(inverse(known.tree.pose_of(a, b), a), known.tree.pose_of(b, a), 1e-8));
  }));
}

TEST(FrameTreeProperties, AWayOverAThirdFrameIsTheSameWay) {
  EXPECT_TRUE(rc::check([] {
    const KnownTree known;
    const auto& a = known.any_frame();
    const auto& b = known.any_frame();
    const auto& c = known.any_frame();
    const auto over = compose(known.tree.pose_of(b, c), known.tree.pose_of(a, b));
    RC_ASSERT(near(known.tree.pose_of(a, c), over, 1e-8));
    const Pose thing = any_pose(a);
    RC_ASSERT(near(known.tree.transform(known.tree.transform(thing, b), c),
                   known.tree.transform(thing, c), 1e-8));
  }));
}

TEST(FrameTreeProperties, IsATreeWhateverIsAdded) {
  EXPECT_TRUE(rc::check([](const std::vector<std::pair<std::uint8_t, std::uint8_t>>& links) {
    FrameTree tree;
    std::map<std::string, std::string> parents;
    const auto is_above = [&](const std::string& a, std::string b) {
      while (a != b && parents.contains(b))
        b = parents.at(b);
      return a == b;
    };
    for (const auto& [x, y] : links) {
      const auto frame = std::to_string(x % 6);
      const auto parent = std::to_string(y % 6);
      const bool fits =
        parents.contains(frame) ? parents.at(frame) == parent : !is_above(frame, parent);
      bool added = true;
      try {
        tree.add({frame, {{1, 0, 0}, {}, parent}, 0, true});
      } catch (const FrameException&) {
        added = false;
      }
      RC_ASSERT(added == fits);
      if (added)
        parents[frame] = parent;
    }
    // Every frame can be had from all that it is connected to, and from no others.
    for (int i = 0; i < 6; ++i) {
      const auto connected = tree.connected_to(std::to_string(i));
      for (int j = 0; j < 6; ++j)
        RC_ASSERT(tree.find_pose(std::to_string(i), std::to_string(j)).has_value() ==
                  (i == j || std::ranges::count(connected, std::to_string(j)) > 0));
    }
  }));
}

TEST(FrameTreeProperties, MovingFramesAreWhereTheirPosesAreInterpolated) {
  EXPECT_TRUE(rc::check([] {
    FrameTree tree;
    const Pose from = any_pose("map");
    const Pose to = any_pose("map");
    const Pose camera = any_pose("base");
    tree.add({"base", from, 1'000'000, false});
    tree.add({"base", to, 2'000'000, false});
    tree.add({"camera", camera, 0, true});
    const Timestamp time{*rc::gen::inRange<std::int64_t>(900'000, 2'100'001)};
    const auto pose = tree.find_pose("camera", "map", time);
    const bool known = time >= Timestamp{1'000'000} && time <= Timestamp{2'000'000};
    RC_ASSERT(pose.has_value() == known);
    if (!known)
      return;
    const double share = static_cast<double>(time.count() - 1'000'000) / 1'000'000;
    RC_ASSERT(near(*pose, compose(interpolate(from, to, share), camera), 1e-8));
  }));
}

} // namespace

} // namespace castor::geometry::test
