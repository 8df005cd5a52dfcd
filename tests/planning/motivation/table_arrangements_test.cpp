#include "castor/planning/motivation/table_arrangements.hpp"
#include "castor/planning/motivation/table_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace castor::planning {

namespace {

TableThing thing_at(const std::string& name, double x, double y) {
  TableThing result{name, name, "at-" + name, "the " + name, x};
  result.y = y;
  return result;
}

std::vector<const TableThing*> first(const std::vector<TableThing>& table, std::size_t count) {
  std::vector<const TableThing*> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(&table[i]);
  return result;
}

double gap(const TableSpot& a, const TableSpot& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

} // namespace

TEST(TableArrangements, ARowKeepsTheOrderFromLeftToRight) {
  const std::vector table{thing_at("a", 0.1, 0.05), thing_at("b", -0.15, -0.05),
                          thing_at("c", 0, 0.1)};
  const auto row = arranged("in-row", first(table, 3), TableRoom{table});
  ASSERT_EQ(row.size(), 3U);
  EXPECT_EQ(row[0].name, "spot-of-a");
  EXPECT_LT(row[1].x, row[2].x);
  EXPECT_LT(row[2].x, row[0].x);
  EXPECT_DOUBLE_EQ(row[0].y, row[1].y);
  EXPECT_DOUBLE_EQ(row[1].y, row[2].y);
  EXPECT_DOUBLE_EQ(row[2].x - row[1].x, row[0].x - row[2].x);
}

TEST(TableArrangements, NeighboursInARowAreAsFarFromEachOtherWhateverTheirSize) {
  std::vector table{thing_at("a", -0.15, 0.05), thing_at("b", 0, -0.02), thing_at("c", 0.15, 0.04)};
  table[0].radius = 0.05;
  table[1].radius = 0.02;
  const auto row = arranged("in-row", first(table, 3), TableRoom{table});
  ASSERT_EQ(row.size(), 3U);
  const double left = row[1].x - row[0].x - table[0].radius - table[1].radius;
  const double right = row[2].x - row[1].x - table[1].radius - table[2].radius;
  EXPECT_NEAR(left, right, 1e-9);
  EXPECT_NEAR(row[0].y, row[1].y, 1e-9);
  EXPECT_NEAR(row[1].y, row[2].y, 1e-9);
}

TEST(TableArrangements, WhatStandsRightStays) {
  const std::vector table{thing_at("a", -0.12, -0.05), thing_at("b", -0.02, -0.05),
                          thing_at("c", 0.15, 0.1)};
  const auto row = arranged("in-row", first(table, 3), TableRoom{table});
  ASSERT_EQ(row.size(), 3U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(std::hypot(row[i].x - table[i].x, row[i].y - table[i].y), stands_right);
}

TEST(TableArrangements, ARowOnASideOfTheTable) {
  const std::vector table{thing_at("a", -0.15, 0.05), thing_at("b", 0, 0.1),
                          thing_at("c", 0.15, 0)};
  for (const auto& spot : arranged("in-row", first(table, 3), TableRoom{table}, "front"))
    EXPECT_LT(spot.y, -0.05);
  const auto left = arranged("in-column", first(table, 2), TableRoom{table}, "left");
  ASSERT_EQ(left.size(), 2U);
  EXPECT_LT(left[0].x, -0.05);
  EXPECT_LT(left[1].x, -0.05);
  EXPECT_TRUE(arranged("in-row", first(table, 3), TableRoom{table}, "attic").empty());
}

TEST(TableArrangements, AColumnGoesFromTheFrontToTheBack) {
  const std::vector table{thing_at("a", 0.1, 0.05), thing_at("b", -0.15, -0.05)};
  const auto column = arranged("in-column", first(table, 2), TableRoom{table});
  ASSERT_EQ(column.size(), 2U);
  EXPECT_DOUBLE_EQ(column[0].x, column[1].x);
  EXPECT_GT(column[0].y, column[1].y);
}

TEST(TableArrangements, OfTwoRowsTheNearerHalfIsInFront) {
  const std::vector table{thing_at("a", 0.28, 0.05), thing_at("b", -0.28, -0.05),
                          thing_at("c", -0.27, 0.12), thing_at("d", 0.27, -0.1),
                          thing_at("e", -0.29, 0.22)};
  const auto rows = arranged("in-two-rows", first(table, 5), TableRoom{table});
  ASSERT_EQ(rows.size(), 5U);
  // In front: b, d and a, from left to right; behind them e and c.
  EXPECT_DOUBLE_EQ(rows[1].y, rows[3].y);
  EXPECT_DOUBLE_EQ(rows[3].y, rows[0].y);
  EXPECT_DOUBLE_EQ(rows[4].y, rows[2].y);
  EXPECT_LT(rows[0].y, rows[2].y);
  EXPECT_LT(rows[1].x, rows[3].x);
  EXPECT_LT(rows[3].x, rows[0].x);
  EXPECT_LT(rows[4].x, rows[2].x);
}

TEST(TableArrangements, ARingHasOneDistanceFromItsMiddle) {
  const std::vector table{thing_at("a", 0.02, 0.0), thing_at("b", -0.02, 0.02),
                          thing_at("c", 0.0, -0.03), thing_at("d", 0.2, 0.1)};
  const auto ring = arranged("in-ring", first(table, 3), TableRoom{table});
  ASSERT_EQ(ring.size(), 3U);
  EXPECT_NEAR(gap(ring[0], ring[1]), gap(ring[1], ring[2]), 1e-9);
  EXPECT_NEAR(gap(ring[0], ring[1]), gap(ring[0], ring[2]), 1e-9);
}

TEST(TableArrangements, ThingsThatAreSpreadAreFartherFromEachOther) {
  const std::vector table{thing_at("a", -0.05, 0.0), thing_at("b", 0.05, 0.0)};
  const auto spread = arranged("apart", first(table, 2), TableRoom{table});
  ASSERT_EQ(spread.size(), 2U);
  EXPECT_NEAR(gap(spread[0], spread[1]), 0.2, 1e-9);
}

TEST(TableArrangements, ARowInTheMiddleGoesThroughIt) {
  const std::vector table{thing_at("a", -0.15, 0.12), thing_at("b", 0, 0.12),
                          thing_at("c", 0.15, 0.12)};
  const auto row = arranged("in-row", first(table, 3), TableRoom{table}, "centre");
  ASSERT_EQ(row.size(), 3U);
  EXPECT_LE(std::abs(row[0].y), 0.03);
  const auto column = arranged("in-column", first(table, 3), TableRoom{table}, "centre");
  ASSERT_EQ(column.size(), 3U);
  EXPECT_LE(std::abs(column[0].x), 0.03);
}

TEST(TableArrangements, NothingStandsOverTheEdge) {
  std::vector<TableThing> table;
  for (int i = 0; i < 6; ++i)
    table.push_back(thing_at("t" + std::to_string(i), 0.2 + 0.005 * i, -0.2 + 0.08 * i));
  const auto row = arranged("in-row-as-named", first(table, 6), TableRoom{table});
  ASSERT_EQ(row.size(), 6U);
  for (const auto& spot : row)
    EXPECT_LE(std::abs(spot.x), 0.27 + 1e-9);
}

TEST(TableArrangements, ARowAlongAnEdgeIsCloseToIt) {
  const std::vector table{thing_at("a", -0.05, 0.0), thing_at("b", 0.05, 0.05)};
  const auto front = arranged("in-row", first(table, 2), TableRoom{table}, "front-edge");
  ASSERT_EQ(front.size(), 2U);
  EXPECT_NEAR(front[0].y, front[1].y, 1e-9);
  EXPECT_LE(front[0].y, -0.13);
  const auto left = arranged("in-row", first(table, 2), TableRoom{table}, "left-edge");
  ASSERT_EQ(left.size(), 2U);
  EXPECT_NEAR(left[0].x, left[1].x, 1e-9);
  EXPECT_LE(left[0].x, -0.2);
}

TEST(TableArrangements, ThereMayBeNoRoom) {
  std::vector<TableThing> table;
  for (int i = 0; i < 12; ++i)
    table.push_back(thing_at("t" + std::to_string(i), -0.25 + 0.1 * (i % 6), -0.1 + 0.2 * (i / 6)));
  EXPECT_TRUE(arranged("in-row", first(table, 12), TableRoom{table}).empty());
}

TEST(TableArrangements, ThingsArePutWhereTheyCanBe) {
  const std::vector table{thing_at("a", -0.15, 0.05), thing_at("b", 0, 0.1),
                          thing_at("c", 0.15, 0)};
  // The first one cannot be put beyond some line, the others not before it.
  const auto reach = [](const TableThing& x, double, double y) {
    const bool is_reached = x.object == "a" ? y < 0.11 : y > 0.09;
    return is_reached ? spatial::Reach::direct : spatial::Reach::none;
  };
  const auto row = arranged("in-row", first(table, 3), TableRoom{table, reach});
  ASSERT_EQ(row.size(), 3U);
  EXPECT_NEAR(row.front().y, 0.1, 0.011);
  const auto nowhere = [](const TableThing&, double, double) { return spatial::Reach::none; };
  EXPECT_TRUE(arranged("in-row", first(table, 3), TableRoom{table, nowhere}).empty());
}

/// Where it has to be put down on its way, it is put only if there is no other place that is not
/// much farther.
TEST(TableArrangements, ThingsAreRatherPutWhereTheyCanBeDirectly) {
  const std::vector table{thing_at("a", -0.1, 0.0), thing_at("b", 0.1, 0.08)};
  const auto reach = [](const TableThing&, double, double y) {
    return y < -0.05 ? spatial::Reach::direct : spatial::Reach::by_stop;
  };
  for (const auto& spot : arranged("in-row", first(table, 2), TableRoom{table, reach}))
    EXPECT_LT(spot.y, -0.05);
}

/// A row has room where its own things stand, if each can be moved when those have left.
TEST(TableArrangements, ThingsLeaveRoomForOneAnother) {
  const std::vector table{thing_at("a", -0.01, 0.03), thing_at("b", 0.11, -0.02),
                          thing_at("c", 0.06, 0.1)};
  const auto reach = [](const TableThing&, double x, double y) {
    const bool is_reached = std::abs(x) < 0.16 && std::abs(y) < 0.01;
    return is_reached ? spatial::Reach::direct : spatial::Reach::none;
  };
  const auto row = arranged("in-row", first(table, 3), TableRoom{table, reach});
  ASSERT_EQ(row.size(), 3U);
  EXPECT_LT(std::abs(row[0].y), 0.011);
  // Two that stand where the other is to be cannot begin.
  const std::vector crossed{thing_at("a", 0.05, 0.0), thing_at("b", -0.05, 0.0)};
  const auto here_only = [](const TableThing&, double x, double y) {
    const bool is_reached = std::abs(x) < 0.07 && std::abs(y) < 0.01;
    return is_reached ? spatial::Reach::direct : spatial::Reach::none;
  };
  EXPECT_TRUE(
    arranged("in-row-as-named", first(crossed, 2), TableRoom{crossed, here_only}).empty());
}

TEST(TableArrangements, ARowAsNamedHasTheOrderOfTheNames) {
  const std::vector table{thing_at("a", 0.15, 0.05), thing_at("b", -0.15, -0.05),
                          thing_at("c", 0, 0.1)};
  const std::vector<const TableThing*> named{&table[2], &table[0], &table[1]};
  const auto row = arranged("in-row-as-named", named, TableRoom{table});
  ASSERT_EQ(row.size(), 3U);
  EXPECT_EQ(row[0].name, "spot-of-c");
  EXPECT_LT(row[0].x, row[1].x);
  EXPECT_LT(row[1].x, row[2].x);
}

/// On random tables: where there is a place for all, none is put where another thing stays.
TEST(TableArrangements, NothingIsPutWhereAnotherThingStands) {
  std::mt19937 random{5};
  std::uniform_real_distribution<double> across{-0.25, 0.25};
  std::uniform_real_distribution<double> along{-0.15, 0.15};
  std::size_t found = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<TableThing> table;
    while (table.size() < 6) {
      const auto next = thing_at("t" + std::to_string(table.size()), across(random), along(random));
      if (std::ranges::all_of(table, [&](const TableThing& x) {
            return std::hypot(x.x - next.x, x.y - next.y) > x.radius + next.radius;
          }))
        table.push_back(next);
    }
    const auto things = first(table, 3);
    for (const auto* arrangement : {"in-row", "in-column", "in-ring", "apart"}) {
      const auto spots = arranged(arrangement, things, TableRoom{table});
      found += spots.empty() ? 0 : 1;
      for (std::size_t i = 0; i < spots.size(); ++i)
        for (std::size_t j = 0; j < table.size(); ++j)
          if (j != i) {
            const auto other = j < spots.size() ? spots[j] : TableSpot{"", table[j].x, table[j].y};
            // What stands right is not moved.
            EXPECT_GT(gap(other, spots[i]), table[j].radius + things[i]->radius - stands_right);
          }
    }
  }
  EXPECT_GT(found, 300U);
}

/// The map says that things can be put anywhere, but the arm knows better.
TEST(TableArrangements, AreShiftedToWhereTheArmSaysThatItCanPutThings) {
  const std::vector table{thing_at("a", -0.15, 0.1), thing_at("b", 0, 0.08),
                          thing_at("c", 0.15, 0.1)};
  const auto things = first(table, 3);
  std::size_t asked = 0;
  const auto below = [&](double most) -> TableLanding {
    return [&asked, most](const TableThing&, const auto& points, bool) {
      ++asked;
      return std::vector{points.front().y > most ? spatial::Reach::none : spatial::Reach::direct};
    };
  };
  const auto row = arranged("in-row", things, TableRoom{table, reach_in_box, below(0)});
  ASSERT_EQ(row.size(), 3U);
  EXPECT_LE(row[1].y, 0.0);
  EXPECT_DOUBLE_EQ(row[0].y, row[1].y);
  EXPECT_LT(asked, 120U);
  // Sorted groups are, too.
  const auto groups =
    grouped({{&table[0]}, {&table[1], &table[2]}}, TableRoom{table, reach_in_box, below(0.09)});
  ASSERT_EQ(groups.size(), 3U);
  const std::vector<const TableThing*> in_order{&table[0], &table[1], &table[2]};
  for (std::size_t i = 0; i < groups.size(); ++i)
    EXPECT_TRUE(gap(groups[i], {"", in_order[i]->x, in_order[i]->y}) < stands_right ||
                groups[i].y <= 0.09);
}

TEST(TableArrangements, StopOnTheWayOnlyWhereThereIsNoOtherWay) {
  const std::vector table{thing_at("a", -0.15, 0.1), thing_at("b", 0, 0.05),
                          thing_at("c", 0.15, 0.1)};
  const auto by_stop = [](double least) -> TableLanding {
    return [least](const TableThing&, const auto& points, bool may_put_between) {
      return std::vector{points.front().y < least ? spatial::Reach::direct
                         : may_put_between        ? spatial::Reach::by_stop
                                                  : spatial::Reach::none};
    };
  };
  const auto row = arranged("in-row", first(table, 3), TableRoom{table, reach_in_box, by_stop(0)});
  ASSERT_EQ(row.size(), 3U);
  EXPECT_LT(row[0].y, 0);
  EXPECT_EQ(arranged("in-row", first(table, 3), TableRoom{table, reach_in_box, by_stop(-1)}).size(),
            3U);
}

TEST(TableArrangements, WhatTheArmSaysCannotBePutAnywhereIsKnown) {
  const std::vector table{thing_at("a", -0.15, 0.1), thing_at("b", 0, 0.05),
                          thing_at("c", 0.15, 0.1)};
  const TableRoom room{table, reach_in_box, [](const TableThing& x, const auto&, bool) {
                         return std::vector{x.object == "c" ? spatial::Reach::none
                                                            : spatial::Reach::direct};
                       }};
  EXPECT_TRUE(arranged("in-row", first(table, 3), room, "front").empty());
  ASSERT_NE(room.landings().most_often_beyond(), nullptr);
  EXPECT_EQ(room.landings().most_often_beyond()->object, "c");
}

/// As near as single things are.
TEST(TableArrangements, ARowAtAnEdgeIsAsNearToItAsItIsReached) {
  const std::vector table{thing_at("a", -0.15, 0.1), thing_at("b", 0, -0.05)};
  const auto everywhere = [](const TableThing&, double, double) { return spatial::Reach::direct; };
  const auto rim = [&](double least) {
    const auto reach = [least](const TableThing&, double, double y) {
      return y >= least ? spatial::Reach::direct : spatial::Reach::none;
    };
    const auto row = arranged("in-row", first(table, 2), TableRoom{table, reach}, "front-edge");
    return row.size() < 2 ? 1.0 : table_half_depth + row[0].y - table[0].radius;
  };
  EXPECT_LT(rim(-1), 0.031);
  EXPECT_NEAR(rim(-0.185), table_half_depth - 0.185 - table[0].radius, 0.011);
  const auto column =
    arranged("in-row", first(table, 2), TableRoom{table, everywhere}, "left-edge");
  ASSERT_EQ(column.size(), 2U);
  EXPECT_LT(table_half_width + column[0].x - table[0].radius, 0.031);
}

} // namespace castor::planning
