#include "castor/perception/vision/scene_watch.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace castor::vision {

namespace {

Image grey_frame(std::uint8_t grey, std::uint32_t width = 20, std::uint32_t height = 10) {
  return {width, height, 3, std::vector<std::uint8_t>(width * height * 3, grey)};
}

/// "c" for changing, "C" for changed, "." for silence.
std::string reaction(SceneWatch& watch, const Image& frame) {
  auto x = watch.observe(frame);
  if (!x)
    return ".";
  EXPECT_NE(x->changing, x->changed);
  EXPECT_FALSE(x->processed);
  return x->changing ? "c" : "C";
}

TEST(SceneWatch, TheFirstFrameIsAChangeThatComesToRest) {
  SceneWatch watch;
  std::string told;
  for (int i = 0; i < 6; ++i)
    told += reaction(watch, grey_frame(100));
  EXPECT_EQ(told, "cccC..");
}

TEST(SceneWatch, TheFirstFrameNeedNotCount) {
  SceneWatchOptions options;
  options.first_frame_counts = false;
  SceneWatch watch{options};
  std::string told;
  for (int i = 0; i < 3; ++i)
    told += reaction(watch, grey_frame(100));
  told += reaction(watch, grey_frame(160));
  for (int i = 0; i < 4; ++i)
    told += reaction(watch, grey_frame(160));
  EXPECT_EQ(told, "...cccC.");
}

TEST(SceneWatch, RestIsCountedFromTheLastChange) {
  SceneWatch watch;
  std::string told;
  for (int grey : {0, 100, 100, 0, 0, 0, 0, 0})
    told += reaction(watch, grey_frame(static_cast<std::uint8_t>(grey)));
  EXPECT_EQ(told, "ccccccC.");
}

/// With a square of `side` pixels of another grey.
Image frame_with_square(std::uint32_t side) {
  Image frame = grey_frame(100, 200, 100);
  for (std::uint32_t y = 40; y < 40 + side; ++y)
    for (std::uint32_t x = 60 * 3; x < (60 + side) * 3; ++x)
      frame.bytes[y * frame.width * 3 + x] = 160;
  return frame;
}

TEST(SceneWatch, ASmallThingIsAChangeAndScatteredPixelsAreNot) {
  SceneWatch watch;
  for (int i = 0; i < 4; ++i)
    watch.observe(grey_frame(100, 200, 100));
  Image scattered = grey_frame(100, 200, 100);
  for (std::uint32_t cell = 0; cell < 200 * 100; cell += 701)
    scattered.bytes[cell * 3] = scattered.bytes[cell * 3 + 1] = scattered.bytes[cell * 3 + 2] = 160;
  EXPECT_EQ(reaction(watch, scattered), ".");
  EXPECT_EQ(reaction(watch, grey_frame(100, 200, 100)), ".");
  EXPECT_EQ(reaction(watch, frame_with_square(3)), ".");
  EXPECT_EQ(reaction(watch, grey_frame(100, 200, 100)), ".");
  EXPECT_EQ(reaction(watch, frame_with_square(5)), "c");
}

TEST(SceneWatch, NoiseIsNoChange) {
  SceneWatch watch;
  for (int i = 0; i < 4; ++i)
    watch.observe(grey_frame(100));
  EXPECT_EQ(reaction(watch, grey_frame(119)), ".");
  EXPECT_EQ(reaction(watch, grey_frame(140)), "c");
}

TEST(SceneWatch, AFewPixelsAreNoChange) {
  SceneWatch watch;
  auto frame = grey_frame(100, 100, 100);
  for (int i = 0; i < 4; ++i)
    watch.observe(frame);
  // 0.3 % of 10,000 pixels are 30.
  for (std::size_t i = 0; i < 30 * 3; ++i)
    frame.bytes[i] = 200;
  EXPECT_EQ(reaction(watch, frame), ".");
  for (std::size_t i = 0; i < 61 * 3; ++i)
    frame.bytes[i] = 0;
  EXPECT_EQ(reaction(watch, frame), "c");
}

TEST(SceneWatch, AnotherSizeIsAChange) {
  SceneWatch watch;
  for (int i = 0; i < 4; ++i)
    watch.observe(grey_frame(100));
  EXPECT_EQ(reaction(watch, grey_frame(100, 10, 10)), "c");
}

} // namespace

} // namespace castor::vision
