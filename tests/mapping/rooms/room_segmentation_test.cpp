// Rooms of small floor plans, and what holds in any map.

#include "castor/mapping/rooms/room_segmentation.hpp"
#include "castor/mapping/rooms/rooms_picture.hpp"
#include "castor/tests/mapping/rooms/drawn_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>

namespace castor::mapping::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Two rooms of 4 m by 3 m beside each other, and below them a corridor of 1.6 m; doors of 0.9 m.
DrawnMap office() {
  DrawnMap x(9.2, 5.6);
  x.free(0.5, 2.3, 4, 3).free(4.7, 2.3, 4, 3).free(0.5, 0.5, 8.2, 1.6);
  x.free(2, 2.1, 0.9, 0.2).free(6, 2.1, 0.9, 0.2);
  return x;
}

std::int32_t room_at(const CellMap& map, const SegmentedRooms& rooms, double x, double y) {
  auto column = static_cast<std::size_t>(x / map.cell_size);
  auto row = static_cast<std::size_t>(y / map.cell_size);
  return rooms.labels[row * static_cast<std::size_t>(map.columns) + column];
}

void expect_office(const CellMap& map, const SegmentedRooms& found) {
  ASSERT_EQ(found.rooms.size(), 3U);
  auto corridor = room_at(map, found, 4.5, 1.2);
  auto left = room_at(map, found, 2, 4);
  auto right = room_at(map, found, 7, 4);
  EXPECT_EQ((std::set{corridor, left, right}), (std::set<std::int32_t>{1, 2, 3}));
  auto area = [&](auto x) { return found.rooms[static_cast<std::size_t>(x) - 1].area; };
  EXPECT_NEAR(area(corridor), 8.2 * 1.6, 0.4);
  EXPECT_NEAR(area(left), 12, 0.4);
  EXPECT_NEAR(area(right), 12, 0.4);
}

} // namespace

TEST(RoomSegmentation, DividesAtDoors) {
  auto map = office().map();
  auto found = segment_rooms(map);
  expect_office(map, found);
  EXPECT_EQ(found.openings.size(), 2U);
  for (const auto& x : found.openings) {
    EXPECT_NEAR(x.width, 0.9, 0.11);
    EXPECT_NEAR(x.from.y, 2.2, 0.15);
    EXPECT_NEAR(x.to.y, 2.2, 0.15);
  }
  auto corridor = room_at(map, found, 4.5, 1.2);
  EXPECT_EQ(corridor, 1);
  EXPECT_THAT(found.rooms[0].neighbours, ElementsAre(2, 3));
  EXPECT_THAT(found.rooms[1].neighbours, ElementsAre(1));
}

TEST(RoomSegmentation, RoomsKeepTheirShapeWithFurniture) {
  auto x = office();
  // Legs of a table, a bin beside the door, a cupboard at the wall.
  for (double column : {1.5, 2.5})
    for (double row : {3., 4.})
      x.occupied(column, row, 0.05, 0.05);
  x.occupied(3.1, 2.5, 0.4, 0.4).occupied(4.7, 4.8, 1.5, 0.5);
  auto found = segment_rooms(x.map());
  ASSERT_EQ(found.rooms.size(), 3U);
  EXPECT_NEAR(found.rooms[static_cast<std::size_t>(room_at(x.map(), found, 2, 4)) - 1].area, 12,
              0.4);
  EXPECT_NEAR(found.rooms[static_cast<std::size_t>(room_at(x.map(), found, 7, 4)) - 1].area, 11.25,
              0.4);
}

TEST(RoomSegmentation, FindsTheSameRoomsInANoisyMap) {
  auto x = office().map();
  std::mt19937 random(1);
  // Cells that are wrong, unknown ones, and walls that are not straight.
  std::bernoulli_distribution wrong(0.005);
  std::bernoulli_distribution rough(0.3);
  const auto clean = x;
  for (int row = 1; row + 1 < x.rows; ++row)
    for (int column = 1; column + 1 < x.columns; ++column) {
      auto at_wall = clean.at(column, row) == 0 &&
                     (clean.at(column - 1, row) != 0 || clean.at(column + 1, row) != 0 ||
                      clean.at(column, row - 1) != 0 || clean.at(column, row + 1) != 0);
      if (at_wall && rough(random))
        x.at(column, row) = 80;
      else if (clean.at(column, row) == 0 && wrong(random))
        x.at(column, row) = random() % 2 == 0 ? -1 : 100;
    }
  expect_office(x, segment_rooms(x));
}

TEST(RoomSegmentation, CutsACorridorOffWhereItEntersAHall) {
  auto map = DrawnMap(14, 8).free(0.5, 0.5, 7, 7).free(7.5, 3, 6, 1.5).map();
  auto found = segment_rooms(map);
  // The corridor's widest place is its own: nothing tells it from a niche of the hall but its
  // mouth.
  ASSERT_EQ(found.rooms.size(), 1U);
  // With a place to turn at its end it is a space of its own, up to the hall.
  map = DrawnMap(14, 8).free(0.5, 0.5, 7, 7).free(7.5, 3, 6, 1.5).free(11, 2, 2.5, 3.5).map();
  found = segment_rooms(map);
  ASSERT_EQ(found.rooms.size(), 2U);
  EXPECT_EQ(room_at(map, found, 7.8, 3.7), room_at(map, found, 12, 3.7));
  ASSERT_EQ(found.openings.size(), 1U);
  EXPECT_NEAR(found.openings[0].from.x, 7.5, 0.3);
  EXPECT_NEAR(found.openings[0].width, 1.5, 0.15);
}

TEST(RoomSegmentation, CutsAllOpeningsInARow) {
  DrawnMap x(8, 8.2);
  x.free(0.5, 0.5, 7, 3.5).free(0.5, 4.2, 7, 3.5);
  for (double column : {1., 3., 5.5})
    x.free(column, 4, 1, 0.2);
  auto found = segment_rooms(x.map());
  ASSERT_EQ(found.rooms.size(), 2U);
  EXPECT_EQ(found.openings.size(), 3U);
  EXPECT_NEAR(found.rooms[0].area, found.rooms[1].area, 0.7);
}

TEST(RoomSegmentation, PlacesAreInTheFrameOfTheMap) {
  auto x = office();
  const auto there = segment_rooms(x.map());
  const Pose2 origin{10, -5, std::numbers::pi / 2};
  const auto turned = segment_rooms(x.at(origin).map());
  ASSERT_EQ(there.rooms.size(), turned.rooms.size());
  for (std::size_t i = 0; i < there.rooms.size(); ++i) {
    auto expected = transform(origin, there.rooms[i].centre);
    EXPECT_NEAR(turned.rooms[i].centre.x, expected.x, 1e-9);
    EXPECT_NEAR(turned.rooms[i].centre.y, expected.y, 1e-9);
    ASSERT_EQ(there.rooms[i].outline.size(), turned.rooms[i].outline.size());
  }
}

TEST(RoomSegmentation, OutlinesGoAnticlockwiseRoundTheRoom) {
  auto found = segment_rooms(DrawnMap(5, 4).free(0.5, 0.5, 4, 3).map());
  ASSERT_EQ(found.rooms.size(), 1U);
  const auto& outline = found.rooms[0].outline;
  double twice_area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& a = outline[i];
    const auto& b = outline[(i + 1) % outline.size()];
    twice_area += a.x * b.y - b.x * a.y;
  }
  EXPECT_EQ(outline.size(), 4U);
  EXPECT_NEAR(twice_area / 2, 3.95 * 2.95, 1e-9);
  EXPECT_NEAR(found.rooms[0].clearance, 1.5, 0.06);
}

TEST(RoomSegmentation, SmallSpacesBelongToTheRoomThatTheyAreOpenTo) {
  auto x = office();
  x.free(0.1, 3, 0.4, 0.6).free(9, 5.5, 0.1, 0.1); // a niche, and free cells that are apart
  auto found = segment_rooms(x.map());
  EXPECT_EQ(found.rooms.size(), 3U);
  EXPECT_EQ(room_at(x.map(), found, 0.2, 3.2), room_at(x.map(), found, 2, 4));
  EXPECT_EQ(room_at(x.map(), found, 9.02, 5.52), 0);
}

TEST(RoomSegmentation, AMapWithoutFreeCellsHasNoRooms) {
  EXPECT_THAT(segment_rooms(CellMap{}).rooms, IsEmpty());
  auto found = segment_rooms(DrawnMap(2, 2).map());
  EXPECT_THAT(found.rooms, IsEmpty());
  EXPECT_EQ(found.labels.size(), 1600U);
}

TEST(RoomSegmentation, RefusesOptionsOutOfTheirRange) {
  auto map = office().map();
  EXPECT_THROW(segment_rooms(map, {.neck_ratio = 0}), std::invalid_argument);
  EXPECT_THROW(segment_rooms(map, {.neck_ratio = 1.1}), std::invalid_argument);
  EXPECT_THROW(segment_rooms(map, {.smallest_room = -1}), std::invalid_argument);
  map.cell_size = 0;
  EXPECT_THROW(segment_rooms(map), std::invalid_argument);
}

RC_GTEST_PROP(RoomSegmentationProperties, EachLargeFreePartIsInARoomAndRoomsAreConsistent, ()) {
  DrawnMap x(8, 6);
  const auto rectangles = *rc::gen::inRange(0, 12);
  for (int i = 0; i < rectangles; ++i) {
    auto metres = [](int most) { return 0.05 * *rc::gen::inRange(0, most); };
    auto left = metres(150);
    auto low = metres(110);
    auto length = std::min(metres(80), 8 - left);
    auto width = std::min(metres(80), 6 - low);
    if (*rc::gen::inRange(0, 3) > 0)
      x.free(left, low, length, width);
    else
      x.occupied(left, low, length, width);
  }
  const auto& map = x.map();
  const RoomOptions options{.smallest_room = 0};
  const auto found = segment_rooms(map, options);
  RC_ASSERT(found.labels.size() == map.cells.size());
  std::vector<std::size_t> sizes(found.rooms.size() + 1, 0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    RC_ASSERT(found.labels[i] >= 0);
    RC_ASSERT(static_cast<std::size_t>(found.labels[i]) < sizes.size());
    RC_ASSERT(map.cells[i] != 0 || found.labels[i] > 0);
    ++sizes[static_cast<std::size_t>(found.labels[i])];
  }
  for (const auto& room : found.rooms) {
    RC_ASSERT(std::abs(room.area -
                       0.0025 * static_cast<double>(sizes[static_cast<std::size_t>(room.number)])) <
              1e-6);
    RC_ASSERT(room.area > 0);
    RC_ASSERT(room_at(map, found, room.centre.x, room.centre.y) == room.number);
    RC_ASSERT(!room.outline.empty());
  }
  for (const auto& opening : found.openings)
    RC_ASSERT(opening.a < opening.b && opening.width >= options.narrowest_opening);
}

TEST(RoomsPicture, IsAPngFileOfTheSizeOfTheMap) {
  auto map = office().map();
  auto png = picture_of(map, segment_rooms(map));
  ASSERT_GT(png.size(), 24U);
  EXPECT_EQ(png[1], 'P');
  // Width and height are the 17th to 24th byte, big-endian.
  EXPECT_EQ(png[18] * 256 + png[19], map.columns);
  EXPECT_EQ(png[22] * 256 + png[23], map.rows);
  EXPECT_THROW(picture_of(CellMap{}, {}), std::runtime_error);
}

} // namespace castor::mapping::test
