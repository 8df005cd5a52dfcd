// The measure of room segmentation by hand-made cases.

#include "castor/benchmarks/rooms/room_scores.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace castor::mapping::test {

namespace {

using testing::ElementsAre;

using Labels = std::vector<std::int32_t>;

RoomScores scores(const Labels& truth, const Labels& found) {
  return room_scores(truth, found, 0);
}

} // namespace

TEST(RoomScores, AreOneForTheTrueRoomsWhateverTheirNumbers) {
  auto x = scores({1, 1, 2, 2, 2, 0}, {7, 7, 3, 3, 3, 0});
  EXPECT_DOUBLE_EQ(x.recall, 1);
  EXPECT_DOUBLE_EQ(x.precision, 1);
  EXPECT_EQ(x.true_rooms, 2U);
  EXPECT_EQ(x.found_rooms, 2U);
}

TEST(RoomScores, ARoomInPiecesCostsRecall) {
  auto x = scores({1, 1, 1, 1, 2, 2}, {1, 1, 1, 3, 2, 2});
  EXPECT_DOUBLE_EQ(x.recall, (0.75 + 1) / 2);
  EXPECT_DOUBLE_EQ(x.precision, 1);
  EXPECT_DOUBLE_EQ(x.recall_by_area, 5. / 6);
}

TEST(RoomScores, RoomsFoundAsOneCostPrecision) {
  auto x = scores({1, 1, 1, 2, 3, 3}, {1, 1, 1, 1, 2, 2});
  EXPECT_DOUBLE_EQ(x.recall, 1);
  EXPECT_DOUBLE_EQ(x.precision, (0.75 + 1) / 2);
  EXPECT_DOUBLE_EQ(x.precision_by_area, 5. / 6);
}

TEST(RoomScores, WhatIsNoTrueRoomCostsPrecision) {
  auto x = scores({1, 1, 0, 0}, {1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(x.recall, 1);
  EXPECT_DOUBLE_EQ(x.precision, 0.5);
}

TEST(RoomScores, WhatWasNotFoundCostsRecall) {
  auto x = scores({1, 1, 2, 2}, {1, 0, 0, 0});
  EXPECT_DOUBLE_EQ(x.recall, (0.5 + 0) / 2);
  EXPECT_DOUBLE_EQ(x.precision, 1);
}

TEST(RoomScores, RoomsUpToTheSmallestSizeAreLeftOut) {
  auto x = room_scores({1, 1, 1, 2, 0}, {1, 1, 1, 2, 3}, 1);
  EXPECT_EQ(x.true_rooms, 1U);
  EXPECT_EQ(x.found_rooms, 1U);
  EXPECT_DOUBLE_EQ(x.recall, 1);
  EXPECT_DOUBLE_EQ(x.precision, 1);
}

TEST(RoomScores, AreZeroWithoutRooms) {
  auto x = scores({0, 0}, {0, 1});
  EXPECT_DOUBLE_EQ(x.recall, 0);
  EXPECT_DOUBLE_EQ(x.precision, 0);
}

TEST(RoomScores, RefuseImagesOfDifferentSize) {
  EXPECT_THROW(scores({1}, {1, 1}), std::invalid_argument);
}

TEST(ConnectedRooms, AreConnectedDiagonallyToo) {
  // 1 . .
  // . 1 .
  // . . .
  // 2 2 .
  EXPECT_THAT(
    connected_rooms(
      {true, false, false, false, true, false, false, false, false, true, true, false}, 3, 4),
    ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 0, 2, 2, 0));
  EXPECT_THROW(connected_rooms({true}, 2, 1), std::invalid_argument);
}

} // namespace castor::mapping::test
