#include "castor/mapping/geometry/camera_model.hpp"

#include "castor/mapping/geometry/eigen_ray.hpp"
#include "castor/mapping/geometry/poses.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace castor::geometry {

using Eigen::Vector3d;

namespace {

Camera sample_camera() {
  return look_at({0, -0.9, 0.7}, {0, 0, 0}, 45, 640, 480);
}

Camera distorted_camera() {
  Camera camera = sample_camera();
  camera.k1 = -0.21;
  camera.k2 = 0.06;
  camera.k3 = -0.004;
  camera.t1 = 0.0008;
  camera.t2 = -0.0005;
  return camera;
}

/// A number in [low, high], by steps of a ten thousandth of the range.
double in_range(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 10'001) / 10'000.0;
}

bool near(const Point3& a, const Point3& b, double tolerance) {
  return (to_eigen(a) - to_eigen(b)).norm() < tolerance;
}

TEST(LookAt, SeesTheTargetInTheMiddle) {
  const auto pixel = project(sample_camera(), {0, 0, 0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 319.5, 1e-9);
  EXPECT_NEAR(pixel->y, 239.5, 1e-9);
}

TEST(LookAt, HasRightToTheRightAndUpUpwards) {
  const Camera camera = sample_camera();
  EXPECT_GT(project(camera, {0.1, 0, 0})->x, 320);
  EXPECT_LT(project(camera, {0, 0, 0.1})->y, 239);
  EXPECT_LT(project(camera, {0, 0.1, 0})->y, 239);
  EXPECT_NEAR(project(camera, {0, 0.1, 0.1})->x, 319.5, 1e-9);
}

TEST(LookAt, SeesTheFieldOfViewFromEdgeToEdge) {
  const Camera camera = look_at({0, 0, 1}, {0, 0, 0}, 90, 200, 100);
  // At a distance of 1 m, 90 degrees are 2 m; the edges are half a pixel off the outermost centres.
  EXPECT_NEAR(back_project(camera, {99.5, -0.5})->y, 1, 1e-9);
  EXPECT_NEAR(back_project(camera, {99.5, 99.5})->y, -1, 1e-9);
}

TEST(LookAt, HasTheFarSideUpwardsWhenItLooksStraightDown) {
  const Camera camera = look_at({0, 0, 1}, {0, 0, 0}, 40, 640, 480);
  EXPECT_LT(project(camera, {0, 0.1, 0})->y, 239);
  EXPECT_GT(project(camera, {0.1, 0, 0})->x, 320);
}

TEST(LookAt, RefusesWhatIsNoCamera) {
  EXPECT_THROW(look_at({0, 0, 1}, {0, 0, 1}, 45, 640, 480), std::invalid_argument);
  EXPECT_THROW(look_at({0, 0, 1}, {0, 0, 0}, 0, 640, 480), std::invalid_argument);
  EXPECT_THROW(look_at({0, 0, 1}, {0, 0, 0}, 180, 640, 480), std::invalid_argument);
  EXPECT_THROW(look_at({0, 0, 1}, {0, 0, 0}, 45, 0, 480), std::invalid_argument);
}

TEST(Project, SeesNothingBehindTheCamera) {
  EXPECT_FALSE(project(sample_camera(), {0, -2, 1.4}));
  EXPECT_FALSE(project(sample_camera(), sample_camera().pose.position));
}

TEST(Project, SeesNothingWhereTheLensModelFolds) {
  Camera camera = sample_camera();
  camera.k1 = -0.5;
  // r (1 - 0.5 r^2) is largest at r = 0.816; far beyond that it would return into the image.
  const Vector3d eye = to_eigen(camera.pose.position);
  const Vector3d forward = to_eigen(rotate(camera.pose.rotation, {0, 0, 1}));
  const Vector3d right = to_eigen(rotate(camera.pose.rotation, {1, 0, 0}));
  EXPECT_TRUE(project(camera, to_point(eye + forward + 0.8 * right)));
  EXPECT_FALSE(project(camera, to_point(eye + forward + 1.4 * right)));
}

TEST(Project, DistortsByTheFormula) {
  Camera camera;
  camera.width = 100;
  camera.height = 100;
  camera.fx = camera.fy = 1;
  camera.k1 = 0.1;
  camera.t1 = 0.01;
  const auto pixel = project(camera, {0.5, 0.2, 1});
  ASSERT_TRUE(pixel);
  const double rr = 0.29;
  EXPECT_NEAR(pixel->x, 0.5 * (1 + 0.1 * rr) + 2 * 0.01 * 0.1, 1e-12);
  EXPECT_NEAR(pixel->y, 0.2 * (1 + 0.1 * rr) + 0.01 * (rr + 2 * 0.04), 1e-12);
}

TEST(BackProject, MissesTheTableAboveTheHorizonAndFromBelow) {
  EXPECT_TRUE(back_project(sample_camera(), {320, 240}));
  const Camera level = look_at({0, -1, 0.5}, {0, 0, 0.5}, 45, 640, 480);
  EXPECT_FALSE(back_project(level, {320, 100}));
  EXPECT_FALSE(back_project(level, {319.5, 239.5}));
  EXPECT_TRUE(back_project(level, {320, 300}));
  EXPECT_TRUE(back_project(level, {320, 100}, 1.0));
  EXPECT_FALSE(back_project(level, {320, 300}, 1.0));
}

TEST(BackProject, HasNoAnswerWithoutFocalLength) {
  EXPECT_FALSE(back_project(Camera{}, {10, 10}));
  EXPECT_FALSE(viewing_ray(Camera{}, {10, 10}));
}

TEST(ViewingRay, HasNoAnswerForPixelsThatTheLensCannotReach) {
  Camera camera = sample_camera();
  camera.k1 = -0.5;
  // The largest distorted radius is 0.816 (1 - 0.5 * 0.667) = 0.544.
  EXPECT_TRUE(viewing_ray(camera, {camera.cx + 0.5 * camera.fx, camera.cy}));
  EXPECT_FALSE(viewing_ray(camera, {camera.cx + 0.6 * camera.fx, camera.cy}));
}

TEST(NominalCamera, SeesTheTableAnd50Degrees) {
  const Camera camera = nominal_camera(800, 600);
  EXPECT_TRUE(camera.is_assumed);
  EXPECT_EQ(camera.width, 800);
  EXPECT_NEAR(2 * std::atan(300 / camera.fy) * 180 / std::numbers::pi, 50, 1e-9);
  EXPECT_TRUE(near(*back_project(camera, {399.5, 299.5}), {0, 0, 0}, 1e-9));
}

TEST(CameraProperties, ProjectionAndBackProjectionAreInverse) {
  EXPECT_TRUE(rc::check([] {
    const Camera camera =
      look_at({in_range(-1, 1), in_range(-1.5, -0.3), in_range(0.3, 1.5)},
              {in_range(-0.3, 0.3), in_range(-0.2, 0.5), 0}, in_range(20, 80), 640, 480);
    const Point3 point{in_range(-0.5, 0.5), in_range(-0.2, 0.8), in_range(0, 0.2)};
    const auto pixel = project(camera, point);
    RC_PRE(pixel.has_value());
    const auto back = back_project(camera, *pixel, point.z);
    RC_ASSERT(back.has_value());
    RC_ASSERT(near(*back, point, 1e-9));
  }));
}

TEST(CameraProperties, DistortionIsUndoneAllOverTheImage) {
  EXPECT_TRUE(rc::check([] {
    const Camera camera = distorted_camera();
    const Point2 pixel{in_range(0, 639), in_range(0, 479)};
    const auto ray = viewing_ray(camera, pixel);
    RC_ASSERT(ray.has_value());
    RC_ASSERT(std::abs(to_eigen(ray->direction).norm() - 1) < 1e-12);
    const auto again = project(camera, to_point(to_eigen(*ray).pointAt(2.5)));
    RC_ASSERT(again.has_value());
    RC_ASSERT(std::hypot(again->x - pixel.x, again->y - pixel.y) < 1e-6);
  }));
}

} // namespace

} // namespace castor::geometry
