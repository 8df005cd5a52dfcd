#include "castor/perception/vision/camera/camera_model.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "castor/perception/vision/camera/camera_model_file.hpp"
#include "castor/perception/vision/camera/eigen_ray.hpp"
#include "castor/tests/support/temporary_folder.hpp"

namespace castor::vision {

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

constexpr auto calibration = "# left camera\n"
                             "size 640 480\n"
                             "focal 612.4 611.9\n"
                             "centre 318.2 243.7\n"
                             "distortion k1 -0.21 k2 0.06 t1 0.0004\n"
                             "eye 0 -90cm 0.7\n"
                             "target 0 0 0   # the middle\n"
                             "number 1\n";

TEST(CameraFile, IsRead) {
  const auto [camera, problems] = parse_camera(calibration, "left.camera");
  EXPECT_EQ(render(problems), "");
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->number, 1);
  EXPECT_EQ(camera->width, 640);
  EXPECT_EQ(camera->fx, 612.4);
  EXPECT_EQ(camera->cy, 243.7);
  EXPECT_EQ(camera->k1, -0.21);
  EXPECT_EQ(camera->t1, 0.0004);
  EXPECT_EQ(camera->t2, 0);
  const auto pixel = project(*camera, {0, 0, 0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 318.2, 1e-9);
  EXPECT_NEAR(pixel->y, 243.7, 1e-9);
}

TEST(CameraFile, MayBeAGuess) {
  const auto text = "fov 50\nsize 800 600\neye 0 -0.75 0.70\ntarget 0 0 0\n";
  Camera same = nominal_camera(800, 600);
  EXPECT_TRUE(same.is_assumed);
  same.is_assumed = false;
  EXPECT_EQ(parse_camera(text, "guess").camera, same);
}

TEST(CameraFile, TellsOfAllProblemsAtOnce) {
  const auto [camera, problems] = parse_camera("size 640\n"
                                               "fokal 600 600\n"
                                               "distortion k1 0.1 k9 0.2\n"
                                               "eye 0 0 1\n"
                                               "eye 0 0 2\n",
                                               "bad.camera");
  EXPECT_FALSE(camera);
  const auto text = render(problems);
  EXPECT_NE(text.find("bad.camera:1: error: \"size\" takes 2 numbers"), std::string::npos) << text;
  EXPECT_NE(text.find("bad.camera:2"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean 'focal'?"), std::string::npos) << text;
  EXPECT_NE(text.find("bad.camera:3"), std::string::npos) << text;
  EXPECT_NE(text.find("\"eye\" is given twice"), std::string::npos) << text;
  EXPECT_NE(text.find("there is no \"target\" line"), std::string::npos) << text;
  EXPECT_NE(text.find("neither a \"focal\" nor a \"fov\""), std::string::npos) << text;
  for (const auto& problem : problems)
    EXPECT_FALSE(problem.remedy.empty()) << problem.message;
}

TEST(CameraFile, RefusesImpossibleNumbers) {
  const std::string rest = "eye 0 0 1\ntarget 0 0 0\n";
  for (const std::string text :
       {"size 0 480\nfov 45\n", "size 6.5 480\nfov 45\n", "size 640 480\nfov 200\n",
        "size 640 480\nfocal 0 600\n", "size 640 480\nfocal nan 600\n",
        "size 640 480\nfov 45\nfocal 600 600\n", "size 640 480\nfov 45\nnumber -1\n",
        "size 1e99 480\nfov 45\n"})
    EXPECT_FALSE(parse_camera(text + rest, "file").camera) << text;
  EXPECT_FALSE(parse_camera("size 640 480\nfov 45\neye 0 0 1\ntarget 0 0 1\n", "file").camera);
}

TEST(CameraFile, IsLoadedOrSaysWhy) {
  test::TemporaryFolder folder;
  std::ofstream(folder / "left.camera") << calibration;
  EXPECT_EQ(load_camera(folder / "left.camera"), parse_camera(calibration, "").camera);
  EXPECT_THROW(load_camera(folder.path()), TextFileError);
  try {
    load_camera(folder / "missing.camera");
    FAIL() << "there is no such file";
  } catch (const TextFileError& error) {
    EXPECT_NE(std::string(error.what()).find("missing.camera"), std::string::npos);
  }
}

TEST(CameraFileProperties, NoTextBreaksTheReader) {
  EXPECT_TRUE(rc::check([](const std::string& text) {
    const auto result = parse_camera(text, "any");
    RC_ASSERT(result.camera.has_value() != has_errors(result.problems));
  }));
}

} // namespace

} // namespace castor::vision
