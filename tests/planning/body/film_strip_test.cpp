#include "castor/planning/body/film_strip.hpp"

#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace castor::manipulation {

namespace {

vision::Image frame(std::uint8_t grey) {
  vision::Image result{64, 48, 3, {}};
  result.bytes.assign(std::size_t{64} * 48 * 3, grey);
  return result;
}

} // namespace

TEST(FilmStrip, HasItsFramesInRows) {
  FilmStrip strip(32, 2);
  EXPECT_TRUE(strip.picture().bytes.empty());
  for (int i = 0; i < 3; ++i)
    strip.add(frame(static_cast<std::uint8_t>(50 * (i + 1))), "step");
  const auto picture = strip.picture();
  EXPECT_EQ(picture.width, 64u);
  EXPECT_EQ(picture.height, 2u * (24 + 22));
  const auto grey_at = [&](std::size_t x, std::size_t y) {
    return picture.bytes[(y * picture.width + x) * 3];
  };
  EXPECT_EQ(grey_at(10, 10), 50);
  EXPECT_EQ(grey_at(42, 10), 100);
  EXPECT_EQ(grey_at(10, 46 + 10), 150);
}

TEST(FilmStrip, IsWrittenAsAPngFile) {
  const test::TemporaryFolder folder;
  FilmStrip strip(32, 2);
  strip.add(frame(90), "step");
  write_png(strip.picture(), folder.path() / "new" / "one.png");
  EXPECT_GT(std::filesystem::file_size(folder.path() / "new" / "one.png"), 100u);
  EXPECT_THROW(write_png(strip.picture(), "/proc/none/one.png"), std::runtime_error);
}

} // namespace castor::manipulation
