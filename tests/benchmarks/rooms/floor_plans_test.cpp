// Rooms of the floor plans of Bormann et al., where they are present.

#include "castor/benchmarks/rooms/floor_plan.hpp"
#include "castor/benchmarks/rooms/other_methods.hpp"
#include "castor/benchmarks/rooms/room_scores.hpp"
#include "castor/mapping/rooms/room_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>

namespace castor::mapping::test {

TEST(FloorPlans, RoomsAreFoundAsWellAsStated) {
  const std::filesystem::path folder = CASTOR_FLOOR_PLANS;
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "there are no floor plans in " << folder;
  const auto plans = floor_plans(folder);
  ASSERT_FALSE(plans.empty());
  for (const auto& variant : floor_plan_variants()) {
    double recall = 0;
    double precision = 0;
    for (const auto& plan : plans) {
      const auto map = read_floor_plan(folder / (plan + variant.suffix + ".png"));
      const auto x = room_scores(read_true_rooms(folder, plan), segment_rooms(map).labels);
      recall += x.recall / static_cast<double>(plans.size());
      precision += x.precision / static_cast<double>(plans.size());
    }
    const bool is_empty = variant.suffix.empty();
    EXPECT_GE(recall, is_empty ? 0.95 : 0.92) << variant.name;
    EXPECT_GE(precision, is_empty ? 0.95 : 0.94) << variant.name;
  }
}

TEST(OtherMethods, FindTwoRoomsWithADoorBetweenThem) {
  CellMap map{.columns = 100, .rows = 50, .cell_size = 0.05, .origin = {}, .cells = {}};
  map.cells.assign(5000, 100);
  for (int row = 5; row < 45; ++row)
    for (int column = 5; column < 95; ++column)
      if (column < 48 || column >= 52 || (row >= 20 && row < 36))
        map.at(column, row) = 0;
  for (const auto& labels : {rooms_by_erosion(map, {}, {.smallest = 1, .largest = 3}),
                             rooms_by_threshold(map, {}), rooms_by_watershed(map, {})}) {
    EXPECT_EQ(std::ranges::max(labels), 2);
    EXPECT_EQ(labels[0], 0);
    EXPECT_NE(labels[25 * 100 + 10], labels[25 * 100 + 90]);
  }
}

} // namespace castor::mapping::test
