#include "castor/mapping/movement/clearance_map.hpp"

#include "castor/tests/mapping/movement/drawn_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::mapping {

namespace {

RC_GTEST_PROP(ClearanceMap, IsTheDistanceFromTheNearestObstacle, ()) {
  CellMap map;
  map.columns = *rc::gen::inRange(1, 20);
  map.rows = *rc::gen::inRange(1, 20);
  map.cell_size = 0.1;
  map.cells = *rc::gen::container<std::vector<std::int8_t>>(
    static_cast<std::size_t>(map.columns * map.rows),
    rc::gen::weightedElement<std::int8_t>({{9, 0}, {1, 100}, {1, -1}}));
  const bool unknown = *rc::gen::arbitrary<bool>();
  const ClearanceMap clearance(map, {.unknown_is_obstacle = unknown});
  const auto is_obstacle = [&](int column, int row) {
    const auto x = map.at(column, row);
    return x < 0 ? unknown : x >= 60;
  };
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      double least = 1e9;
      for (int r = 0; r < map.rows; ++r)
        for (int c = 0; c < map.columns; ++c)
          if (is_obstacle(c, r))
            least = std::min(least, std::hypot(c - column, r - row));
      if (least == 1e9)
        continue;
      const double expected = std::max(0.0, (least - 0.5) * 0.1);
      RC_ASSERT(std::abs(clearance.at(static_cast<std::size_t>(row * map.columns + column)) -
                         expected) < 1e-5);
    }
}

RC_GTEST_PROP(ClearanceMap, IsExactAroundAnObstacleThatIsAdded, ()) {
  auto map = test::empty_room(3, 2, 0.1);
  ClearanceMap clearance(map);
  for (int i = *rc::gen::inRange(0, 5); i > 0; --i) {
    const Point2 place{*rc::gen::inRange(-2, 32) * 0.1 + 0.05,
                       *rc::gen::inRange(-2, 22) * 0.1 + 0.05};
    clearance.add_obstacle(place, 0.5);
    if (const auto cell = clearance.cell_at(place))
      map.cells[*cell] = 100;
  }
  const ClearanceMap expected(map);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (expected.at(i) <= 0.5)
      RC_ASSERT(std::abs(clearance.at(i) - expected.at(i)) < 1e-5);
    RC_ASSERT(clearance.at(i) > expected.at(i) - 1e-5);
  }
}

TEST(ClearanceMap, HasNoneOutsideTheMap) {
  const ClearanceMap clearance(test::empty_room(2, 2));
  EXPECT_GT(clearance.at(Point2{1, 1}), 0.9);
  EXPECT_EQ(clearance.at(Point2{-0.01, 1}), 0);
  EXPECT_EQ(clearance.at(Point2{1, 2.01}), 0);
}

} // namespace

} // namespace castor::mapping
