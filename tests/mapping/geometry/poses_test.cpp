#include "castor/mapping/geometry/poses.hpp"

#include "castor/tests/mapping/geometry/random_poses.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>
#include <tuple>

namespace castor::geometry::test {

namespace {

using Eigen::Vector3d;

constexpr double quarter = std::numbers::pi / 2;

TEST(RotationProperties, KeepLengthsAndAreUndoneByTheInverse) {
  EXPECT_TRUE(rc::check([] {
    const Vector3d z = Vector3d(in_range(-1, 1), in_range(-1, 1), in_range(0.1, 1)).normalized();
    const Vector3d x = Vector3d(0.3, 1, 0.2).cross(z).normalized();
    const Rotation rotation = rotation_from_axes(to_point(x), to_point(z.cross(x)), to_point(z));
    RC_ASSERT(near(rotate(rotation, {1, 0, 0}), to_point(x), 1e-9));
    RC_ASSERT(near(rotate(rotation, {0, 0, 1}), to_point(z), 1e-9));
    const Point3 v{in_range(-1, 1), in_range(-1, 1), in_range(-1, 1)};
    RC_ASSERT(near(rotate(inverse(rotation), rotate(rotation, v)), v, 1e-12));
    const Rotation turn = rotation_about_z(in_range(-3, 3));
    RC_ASSERT(near(rotate(compose(turn, rotation), v), rotate(turn, rotate(rotation, v)), 1e-12));
  }));
}

TEST(Rotation, TurnsAnticlockwiseAboutZ) {
  EXPECT_TRUE(near(rotate(rotation_about_z(std::numbers::pi / 2), {1, 0, 0}), {0, 1, 0}, 1e-12));
}

TEST(Rotation, ComesFromAxesAtHalfTurnsAsWell) {
  // These have no real part, each in one of the branches of the conversion.
  const Point3 x{1, 0, 0};
  const Point3 y{0, 1, 0};
  const Point3 z{0, 0, 1};
  const auto opposite = [](const Point3& v) { return to_point(-to_eigen(v)); };
  for (const auto& [a, b, c] :
       {std::tuple{x, opposite(y), opposite(z)}, std::tuple{opposite(x), y, opposite(z)},
        std::tuple{opposite(x), opposite(y), z}}) {
    const Rotation rotation = rotation_from_axes(a, b, c);
    EXPECT_TRUE(near(rotate(rotation, x), a, 1e-12));
    EXPECT_TRUE(near(rotate(rotation, y), b, 1e-12));
  }
}

TEST(RotationProperties, InterpolationTurnsAtConstantSpeed) {
  EXPECT_TRUE(rc::check([] {
    const Rotation from = any_rotation();
    const Rotation to = any_rotation();
    const double share = in_range(0, 1);
    RC_ASSERT(near(interpolate(from, to, 0), from));
    RC_ASSERT(near(interpolate(from, to, 1), to));
    const double whole = angle_between(from, to);
    RC_PRE(whole < std::numbers::pi - 1e-3);
    RC_ASSERT(std::abs(angle_between(from, interpolate(from, to, share)) - share * whole) < 1e-6);
  }));
}

TEST(Rotation, TakesTheShorterWay) {
  // The same rotation with the opposite sign is no turn at all.
  const Rotation same{-1, 0, 0, 0};
  EXPECT_NEAR(angle_between({}, same), 0, 1e-12);
  EXPECT_TRUE(near(interpolate(Rotation{}, same, 0.5), Rotation{}));
  EXPECT_NEAR(angle_between(rotation_about_z(0), rotation_about_z(quarter)), quarter, 1e-12);
}

TEST(Pose, PlacesPointsThatAreGivenOnTheBody) {
  // One metre to the left of a robot at (2, 1) that looks along y.
  const Pose robot{{2, 1, 0}, rotation_about_z(quarter), "map"};
  EXPECT_TRUE(near(transform(robot, Point3{0, 1, 0}), {1, 1, 0}));
  const Pose camera = compose(robot, {{0.1, 0, 1}, {}, "base"});
  EXPECT_TRUE(near(camera.position, {2, 1.1, 1}));
  EXPECT_EQ(camera.frame, "map");
}

TEST(PoseProperties, CompositionIsAssociativeAndUndoneByTheInverse) {
  EXPECT_TRUE(rc::check([] {
    const Pose a = any_pose("map");
    const Pose b = any_pose("base");
    const Pose c = any_pose("camera");
    const Point3 point = any_point();
    RC_ASSERT(near(compose(compose(a, b), c), compose(a, compose(b, c))));
    RC_ASSERT(near(transform(compose(a, b), point), transform(a, transform(b, point))));
    const Pose back = inverse(a, "base");
    RC_ASSERT(back.frame == "base");
    RC_ASSERT(near(transform(back, transform(a, point)), point));
    RC_ASSERT(near(compose(a, back), Pose{{}, {}, "map"}));
    RC_ASSERT(near(inverse(back, "map"), a));
  }));
}

TEST(PoseProperties, InterpolationBeginsAndEndsThere) {
  EXPECT_TRUE(rc::check([] {
    const Pose from = any_pose("map");
    const Pose to = any_pose("map");
    RC_ASSERT(near(interpolate(from, to, 0), from));
    RC_ASSERT(near(interpolate(from, to, 1), to));
    const double share = in_range(0, 1);
    const Pose between = interpolate(from, to, share);
    RC_ASSERT(std::abs(distance(from.position, between.position) -
                       share * distance(from.position, to.position)) < 1e-9);
  }));
}

TEST(AlignedBox, OfATurnedBoxIsAsLargeAsItsCornersDemand) {
  const Pose turned{{1, 0, 0}, rotation_about_z(quarter), "map"};
  const AlignedBox box = transform(turned, AlignedBox{{0.5, 0, 0.1}, {0.4, 0.2, 0.2}, "base"});
  EXPECT_TRUE(near(box.centroid, {1, 0.5, 0.1}));
  EXPECT_TRUE(near(box.size, {0.2, 0.4, 0.2}));
  EXPECT_EQ(box.frame, "map");
}

TEST(AlignedBoxProperties, HoldsAllCornersAndNoMore) {
  EXPECT_TRUE(rc::check([] {
    const Pose body = any_pose("map");
    const AlignedBox box{any_point(), {in_range(0, 2), in_range(0, 2), in_range(0, 2)}, "base"};
    Eigen::AlignedBox3d corners;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5})
          corners.extend(to_eigen(
            transform(body, Point3{box.centroid.x + x * box.size.x, box.centroid.y + y * box.size.y,
                                   box.centroid.z + z * box.size.z})));
    const AlignedBox result = transform(body, box);
    RC_ASSERT(near(result.centroid, to_point(corners.center())));
    RC_ASSERT(near(result.size, to_point(corners.sizes())));
  }));
}

} // namespace

} // namespace castor::geometry::test
