#include "castor/mapping/building/building_picture.hpp"

#include "castor/mapping/building/building_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace castor::mapping {

namespace {

/// Width and height of a PNG file: its first chunk.
std::pair<std::uint32_t, std::uint32_t> size_of_png(const std::vector<std::uint8_t>& png) {
  constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
  EXPECT_TRUE(png.size() > 24 &&
              std::equal(signature.begin(), signature.end(), png.begin(),
                         [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }));
  auto number = [&](std::size_t at) {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 4; ++i)
      result = result << 8 | png.at(at + i);
    return result;
  };
  return {number(16), number(20)};
}

} // namespace

TEST(BuildingPicture, IsAsLargeAsTheBuilding) {
  auto office = load_building(CASTOR_CONFIGS "/buildings/office.building").building;
  PictureOptions options;
  options.size = 910;
  auto [width, height] = size_of_png(picture_of(office, options));
  // 18.2 m x 15.2 m at 50 pixels a metre, and the margins.
  EXPECT_NEAR(width, 910 + 120, 2);
  EXPECT_NEAR(height, 760 + 160, 2);
  EXPECT_NE(picture_of(office, options),
            picture_of(load_building(CASTOR_CONFIGS "/buildings/office.building").building))
    << "of another size";
}

TEST(BuildingPicture, ShowsThatADoorIsShut) {
  auto office = load_building(CASTOR_CONFIGS "/buildings/office.building").building;
  const auto open = picture_of(office);
  office.doors.front().is_open = false;
  EXPECT_NE(picture_of(office), open);
}

TEST(BuildingPicture, NothingCannotBeDrawn) {
  EXPECT_THROW(picture_of(Building{}), std::runtime_error);
}

} // namespace castor::mapping
