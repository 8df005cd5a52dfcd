#include "castor/perception/vision/camera/open_image_source.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/camera/image_source_probe.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/tests/support/temporary_folder.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

std::vector<char> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const fs::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary)
    .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A picture with some structure, in the given OpenCV type.
cv::Mat picture(int type, int width = 64, int height = 48) {
  cv::Mat pixels(height, width, type);
  cv::randu(pixels, 0, CV_MAT_DEPTH(type) == CV_16U ? 65535 : 255);
  cv::GaussianBlur(pixels, pixels, {5, 5}, 2);
  return pixels;
}

Image plain(std::uint8_t value) {
  return {8, 6, 3, std::vector<std::uint8_t>(8 * 6 * 3, value)};
}

class ImageSourceTest : public testing::Test {
protected:
  ImageSourceTest() {
    options_.clock = [this] { return now_; };
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// What opening it, or reading from it, fails with.
  ImageFault fault_of(const std::string& spec) {
    try {
      open_image_source(spec, options_)->next();
    } catch (const ImageSourceError& error) {
      EXPECT_FALSE(error.remedy().empty());
      EXPECT_FALSE(error.source().empty());
      EXPECT_EQ(error.transient(), error.fault() == ImageFault::device_lost ||
                                     error.fault() == ImageFault::frame_lost);
      return error.fault();
    }
    throw std::logic_error(spec + " could be read");
  }

  test::TemporaryFolder folder_;
  std::chrono::microseconds now_{0};
  ImageSourceOptions options_;
};

TEST_F(ImageSourceTest, StillPictureIsTheSameInEachFrame) {
  write_png(path("a.png"), plain(77));
  const auto source = open_image_source(path("a.png"), options_);
  const auto first = source->next();
  now_ = 5s;
  const auto second = source->next();
  EXPECT_EQ(first.image, plain(77));
  EXPECT_TRUE(first.changed);
  EXPECT_EQ(second.image, first.image);
  EXPECT_FALSE(second.changed);
  EXPECT_EQ(second.time, 5s);
  EXPECT_EQ(second.index, 1U);
  EXPECT_EQ(source->camera(), nominal_camera(8, 6));
  EXPECT_TRUE(source->warnings().empty());
}

TEST_F(ImageSourceTest, CalibrationIsScaledToThePicture) {
  write_png(path("a.png"), plain(77));
  options_.calibration = look_at({0, -0.5, 0.5}, {0, 0, 0}, 40, 16, 12);
  const auto camera = open_image_source(path("a.png"), options_)->camera();
  EXPECT_EQ(camera.width, 8);
  EXPECT_NEAR(camera.fx, options_.calibration->fx / 2, 1e-12);
  EXPECT_NEAR(camera.cx, 3.5, 1e-12);
}

TEST_F(ImageSourceTest, PicturesOfAllKindsBecomeBgr) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4})
    for (const std::string extension : {"png", "tiff"}) {
      const auto name = path("t" + std::to_string(type) + "." + extension);
      ASSERT_TRUE(cv::imwrite(name, picture(type)));
      const auto image = read_image(name);
      EXPECT_EQ(image.width, 64U) << name;
      EXPECT_EQ(image.channels, 3U) << name;
      EXPECT_EQ(image.bytes.size(), 64U * 48 * 3) << name;
    }
  for (const std::string extension : {"jpg", "bmp", "ppm", "webp"}) {
    ASSERT_TRUE(cv::imwrite(path("t." + extension), picture(CV_8UC3)));
    EXPECT_EQ(read_image(path("t." + extension)).height, 48U) << extension;
  }
  ASSERT_TRUE(cv::imwrite(path("t.pgm"), picture(CV_8UC1)));
  EXPECT_EQ(read_image(path("t.pgm")).channels, 3U);
}

TEST_F(ImageSourceTest, FormatIsFoundByContentNotByName) {
  ASSERT_TRUE(cv::imwrite(path("a.jpg"), picture(CV_8UC3)));
  fs::rename(path("a.jpg"), path("a.png"));
  EXPECT_EQ(read_image(path("a.png")).width, 64U);
  fs::rename(path("a.png"), path("a"));
  EXPECT_EQ(open_image_source(path("a"), options_)->next().image.width, 64U);
}

TEST_F(ImageSourceTest, FilesThatEndEarlyAreReported) {
  for (const std::string name : {"a.jpg", "a.png", "a.bmp", "a.ppm", "a.webp"}) {
    ASSERT_TRUE(cv::imwrite(path(name), picture(CV_8UC3, 200, 150)));
    auto bytes = bytes_of(path(name));
    bytes.resize(bytes.size() * 2 / 3);
    write_bytes(path(name), bytes);
    EXPECT_EQ(fault_of(path(name)), ImageFault::truncated) << name;
    bytes.resize(20);
    write_bytes(path(name), bytes);
    EXPECT_EQ(fault_of(path(name)), ImageFault::truncated) << name;
  }
  write_bytes(path("empty.png"), {});
  EXPECT_EQ(fault_of(path("empty.png")), ImageFault::truncated);
}

TEST_F(ImageSourceTest, DamagedPngIsReported) {
  ASSERT_TRUE(cv::imwrite(path("a.png"), picture(CV_8UC3)));
  auto bytes = bytes_of(path("a.png"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  write_bytes(path("a.png"), bytes);
  EXPECT_EQ(fault_of(path("a.png")), ImageFault::truncated);
}

TEST_F(ImageSourceTest, HugePicturesAreRefusedBeforeTheyAreDecoded) {
  write_png(path("a.png"), plain(1));
  options_.limits.max_pixels = 47;
  EXPECT_EQ(fault_of(path("a.png")), ImageFault::too_large);
  options_.limits.max_pixels = 48;
  EXPECT_NO_THROW(open_image_source(path("a.png"), options_));
  options_.limits.max_bytes = 10;
  EXPECT_EQ(fault_of(path("a.png")), ImageFault::too_large);
  options_.limits = {};
  // Only its header says that it is huge.
  std::ofstream(path("huge.pgm")) << "P5\n60000 60000\n255\n";
  EXPECT_EQ(fault_of(path("huge.pgm")), ImageFault::too_large);
}

TEST_F(ImageSourceTest, GarbageNeverBreaksAnything) {
  std::mt19937 random(1);
  const std::vector<std::string> starts{"",
                                        "\x89PNG\r\n\x1A\n",
                                        "\xFF\xD8\xFF\xE0",
                                        "BM",
                                        "P6 ",
                                        "P2\n9 9\n255\n",
                                        "RIFF1234WEBPVP8 ",
                                        "P4\n8 8\n",
                                        "II*",
                                        "MM",
                                        "GIF89a",
                                        "P5 3 3 255 "};
  for (int round = 0; round < 300; ++round) {
    const auto& start = starts[static_cast<std::size_t>(round) % starts.size()];
    std::vector<char> bytes(start.begin(), start.end());
    if (start == "II*")
      bytes.push_back('\0');
    for (auto count = random() % 400; count > 0; --count)
      bytes.push_back(static_cast<char>(random()));
    const auto name = path(round % 2 == 0 ? "garbage.png" : "garbage.jpg");
    write_bytes(name, bytes);
    try {
      const auto image = read_image(name);
      EXPECT_EQ(image.bytes.size(), std::size_t{image.width} * image.height * 3);
    } catch (const ImageSourceError& error) {
      EXPECT_FALSE(error.transient());
    }
  }
}

TEST_F(ImageSourceTest, DamagedPicturesNeverBreakAnything) {
  std::mt19937 random(2);
  for (const std::string name : {"a.bmp", "a.ppm", "a.webp", "a.tiff"}) {
    ASSERT_TRUE(cv::imwrite(path(name), picture(CV_8UC3)));
    const auto whole = bytes_of(path(name));
    for (int round = 0; round < 40; ++round) {
      auto bytes = whole;
      for (int i = 0; i < 4; ++i)
        bytes[random() % std::min<std::size_t>(bytes.size(), 200)] = static_cast<char>(random());
      write_bytes(path(name), bytes);
      try {
        read_image(path(name));
      } catch (const ImageSourceError& error) {
        EXPECT_FALSE(error.transient());
      }
    }
  }
}

TEST_F(ImageSourceTest, ProbeTellsSizesOfAllFormats) {
  for (const std::string name : {"a.jpg", "a.png", "a.bmp", "a.ppm", "a.webp", "a.tiff"}) {
    ASSERT_TRUE(cv::imwrite(path(name), picture(CV_8UC3, 123, 77)));
    const auto bytes = bytes_of(path(name));
    const auto probe =
      probe_image({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    ASSERT_TRUE(probe) << name;
    EXPECT_EQ(probe->width, 123U) << name;
    EXPECT_EQ(probe->height, 77U) << name;
    EXPECT_TRUE(probe->complete) << name;
  }
}

TEST_F(ImageSourceTest, FolderGoesThroughItsPicturesInNaturalOrder) {
  write_png(path("shot10.png"), plain(10));
  write_png(path("shot2.png"), plain(2));
  write_png(path("Shot1.PNG"), plain(1));
  std::ofstream(path("notes.txt")) << "no picture";
  const auto source = open_image_source(folder_.path().string(), options_);
  for (const int expected : {1, 2, 10, 1}) {
    const auto frame = source->next();
    EXPECT_EQ(frame.image.bytes[0], expected);
    EXPECT_TRUE(frame.changed);
  }
  EXPECT_NE(source->description().find("3 pictures"), std::string::npos);
}

TEST_F(ImageSourceTest, FolderMayHoldItsLastPicture) {
  write_png(path("1.png"), plain(1));
  write_png(path("2.png"), plain(2));
  options_.at_end = ImageSourceOptions::AtEnd::hold_last;
  const auto source = open_image_source(folder_.path().string(), options_);
  EXPECT_EQ(source->next().image.bytes[0], 1);
  EXPECT_EQ(source->next().image.bytes[0], 2);
  const auto held = source->next();
  EXPECT_EQ(held.image.bytes[0], 2);
  EXPECT_FALSE(held.changed);
  EXPECT_EQ(held.index, 2U);
}

TEST_F(ImageSourceTest, FolderGoesOnBehindABadPicture) {
  write_png(path("1.png"), plain(1));
  write_bytes(path("2.png"), {'x'});
  write_png(path("3.png"), plain(3));
  const auto source = open_image_source(folder_.path().string(), options_);
  EXPECT_EQ(source->next().image.bytes[0], 1);
  try {
    source->next();
    FAIL() << "the second picture is none";
  } catch (const ImageSourceError& error) {
    EXPECT_TRUE(error.transient());
    EXPECT_NE(std::string(error.what()).find("2.png"), std::string::npos);
  }
  EXPECT_EQ(source->next().image.bytes[0], 3);
}

TEST_F(ImageSourceTest, FolderOfBadPicturesGivesUp) {
  write_bytes(path("1.png"), {'x'});
  EXPECT_EQ(fault_of(folder_.path().string()), ImageFault::not_an_image);
}

TEST_F(ImageSourceTest, FaultsAreToldApart) {
  EXPECT_EQ(fault_of(path("missing.png")), ImageFault::not_found);
  EXPECT_EQ(fault_of(""), ImageFault::not_found);
  EXPECT_EQ(fault_of("scne:table.scene"), ImageFault::unknown_kind);
  EXPECT_EQ(fault_of(folder_.path().string()), ImageFault::empty_folder);
  EXPECT_EQ(fault_of("/dev/video97"), ImageFault::device_lost);
  std::ofstream(path("text.png")) << "this is a text";
  EXPECT_EQ(fault_of(path("text.png")), ImageFault::not_an_image);
  std::ofstream(path("text.dat")) << "this is a text";
  EXPECT_EQ(fault_of(path("text.dat")), ImageFault::unknown_kind);
  std::ofstream(path("text.avi")) << "this is a text";
  EXPECT_EQ(fault_of(path("text.avi")), ImageFault::not_an_image);
  std::ofstream(path("bad.scene")) << "bleu square at 0 0\n";
  EXPECT_EQ(fault_of("scene:" + path("bad.scene")), ImageFault::bad_scene);
}

TEST_F(ImageSourceTest, RelativeNamesAreLookedForInTheBaseDirectory) {
  write_png(path("only_there.png"), plain(5));
  EXPECT_EQ(fault_of("only_there.png"), ImageFault::not_found);
  options_.base_directory = folder_.path();
  EXPECT_EQ(open_image_source("only_there.png", options_)->next().image.bytes[0], 5);
  try {
    open_image_source("nowhere.png", options_);
    FAIL() << "there is no such file";
  } catch (const ImageSourceError& error) {
    EXPECT_NE(std::string(error.what()).find(path("nowhere.png")), std::string::npos);
  }
}

TEST_F(ImageSourceTest, VideoIsPlayedAndLooped) {
  {
    cv::VideoWriter writer(path("a.avi"), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10,
                           {64, 48});
    ASSERT_TRUE(writer.isOpened());
    for (const int value : {50, 100, 200})
      writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(value)));
  }
  const auto source = open_image_source(path("a.avi"), options_);
  EXPECT_EQ(source->camera(), nominal_camera(64, 48));
  for (const int expected : {50, 100, 200, 50, 100, 200})
    EXPECT_NEAR(source->next().image.bytes[0], expected, 4);
  options_.at_end = ImageSourceOptions::AtEnd::hold_last;
  const auto held = open_image_source(path("a.avi"), options_);
  for (const int expected : {50, 100, 200, 200, 200}) {
    EXPECT_NEAR(held->next().image.bytes[0], expected, 4);
  }
  EXPECT_FALSE(held->next().changed);
}

TEST_F(ImageSourceTest, SceneIsShownAsItIsAtTheTime) {
  const std::string text = "image 64 48\nnoise 2\nafter 2s add blue square at 0 0\n";
  std::ofstream(path("a.scene")) << text;
  const auto source = open_image_source("scene:" + path("a.scene"), options_);
  const auto scene = parse_tabletop_scene(text, "").scene;
  EXPECT_EQ(source->camera(), scene.camera);
  const auto first = source->next();
  EXPECT_EQ(first.image, render(scene.at(0s), scene.camera));
  now_ = 1s;
  const auto second = source->next();
  EXPECT_FALSE(second.changed);
  EXPECT_NE(second.image, first.image) << "the noise is new in each frame";
  now_ = 2s;
  const auto third = source->next();
  EXPECT_TRUE(third.changed);
  EXPECT_EQ(third.time, 2s);
  RenderOptions third_frame;
  third_frame.frame = 2;
  EXPECT_EQ(third.image, render(scene.at(2s), scene.camera, third_frame));
}

TEST_F(ImageSourceTest, SceneIsShownAsItsFileSaysAfterAnEdit) {
  const std::string before = "image 64 48\nnoise 0\nred cube at 0 0\n";
  const std::string after = "image 64 48\nnoise 0\ncamera 0 -0.9 0.8 looking-at 0 0 0\n"
                            "red cube at 0.1 0.1\nafter 1s add blue square at -0.1 0\n";
  std::ofstream(path("a.scene")) << before;
  const auto source = open_image_source("scene:" + path("a.scene"), options_);
  now_ = 5s;
  source->next();
  EXPECT_FALSE(source->next().changed);
  std::ofstream(path("a.scene")) << after;
  const auto frame = source->next();
  const auto scene = parse_tabletop_scene(after, "").scene;
  EXPECT_TRUE(frame.changed);
  EXPECT_EQ(frame.image, render(scene.at(5s), scene.camera)) << "its time goes on";
  EXPECT_EQ(source->camera(), scene.camera);
  EXPECT_FALSE(source->next().changed);
}

TEST_F(ImageSourceTest, SceneWhoseEditHasErrorsIsShownAsItWas) {
  const std::string text = "image 64 48\nnoise 0\nred cube at 0 0\n";
  std::ofstream(path("a.scene")) << text;
  const auto source = open_image_source("scene:" + path("a.scene"), options_);
  const auto first = source->next().image;
  std::ofstream(path("a.scene")) << "image 64 48\nbleu square at 0 0\n";
  try {
    source->next();
    FAIL() << "the edit has an error";
  } catch (const ImageSourceError& error) {
    EXPECT_EQ(error.fault(), ImageFault::bad_edit);
    EXPECT_TRUE(error.transient());
    const std::string what = error.what();
    EXPECT_NE(what.find("a.scene:2"), std::string::npos) << what;
    EXPECT_NE(what.find("it is shown as it was"), std::string::npos) << what;
  }
  EXPECT_EQ(source->next().image, first) << "an error is told once";
  fs::remove(path("a.scene"));
  EXPECT_EQ(source->next().image, first);
  std::ofstream(path("a.scene")) << "image 64 48\nnoise 0\nblue square at 0 0\n";
  EXPECT_TRUE(source->next().changed);
}

TEST_F(ImageSourceTest, SceneTellsOfItsWarnings) {
  std::ofstream(path("a.scene")) << "red cube at 0.99 0\n";
  const auto source = open_image_source(path("a.scene"), options_);
  EXPECT_FALSE(source->warnings().empty());
}

TEST_F(ImageSourceTest, WrittenPicturesAreReadAgain) {
  Image grey{4, 2, 1, {0, 1, 2, 3, 4, 5, 6, 255}};
  write_png(path("grey.png"), grey);
  const auto image = read_image(path("grey.png"));
  ASSERT_EQ(image.bytes.size(), 24U);
  for (std::size_t i = 0; i < grey.bytes.size(); ++i)
    EXPECT_EQ(image.bytes[3 * i], grey.bytes[i]);
  try {
    write_png(path("no/such/folder.png"), grey);
    FAIL() << "the folder does not exist";
  } catch (const ImageSourceError& error) {
    EXPECT_EQ(error.fault(), ImageFault::unwritable);
  }
  EXPECT_THROW(write_png(path("bad.png"), Image{2, 2, 3, {1, 2}}), std::invalid_argument);
  EXPECT_THROW(write_png(path("bad.png"), Image{}), std::invalid_argument);
}

} // namespace

} // namespace castor::vision
