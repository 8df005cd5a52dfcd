#include "castor/perception/vision/camera/camera_model_file.hpp"

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <fstream>
#include <string>

namespace castor::vision {

using namespace geometry;

namespace {

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
  EXPECT_EQ(camera->pose.frame, "table");
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

TEST(CameraFile, NamesTheFrameOfEyeAndTarget) {
  const std::string rest = "fov 50\nsize 800 600\neye 0 0 1\ntarget 1 0 0\n";
  const auto [camera, problems] = parse_camera(rest + "frame base\n", "head");
  ASSERT_TRUE(camera) << render(problems);
  EXPECT_EQ(camera->pose.frame, "base");
  EXPECT_FALSE(parse_camera(rest + "frame\n", "head").camera);
  EXPECT_FALSE(parse_camera(rest + "frame the base\n", "head").camera);
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
