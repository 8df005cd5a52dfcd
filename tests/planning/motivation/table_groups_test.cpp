#include "castor/planning/motivation/table_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace castor::planning {

namespace {

using Group = std::vector<const TableThing*>;

TableThing group_member(const std::string& name, double x, double y, double radius = 0.03) {
  TableThing result{"p/" + name, name, "at-" + name, "the " + name, x};
  result.y = y;
  result.radius = radius;
  return result;
}

/// From each thing to the nearest of its own group, and of others.
void expect_together(const std::vector<Group>& groups, const std::vector<TableSpot>& spots) {
  struct Member {
    const TableThing* thing;
    std::size_t group;
  };
  std::vector<Member> all;
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (const auto* x : groups[i])
      all.push_back({x, i});
  ASSERT_EQ(spots.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    double own = std::numeric_limits<double>::infinity();
    double other = own;
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (j == i)
        continue;
      auto& least = all[i].group == all[j].group ? own : other;
      least = std::min(least, std::hypot(spots[i].x - spots[j].x, spots[i].y - spots[j].y) -
                                all[i].thing->radius - all[j].thing->radius);
    }
    if (groups[all[i].group].size() > 1) {
      EXPECT_LT(own, other) << all[i].thing->object;
    }
  }
}

} // namespace

TEST(TableGroups, OneGoesToTheOther) {
  const std::vector<TableThing> table{group_member("a", -0.2, 0.1), group_member("b", 0.2, 0.0),
                                      group_member("c", 0.05, -0.1)};
  const std::vector<Group> groups{{&table[0]}, {&table[1], &table[2]}};
  const auto spots = grouped(groups, TableRoom{table});
  expect_together(groups, spots);
  const auto moved = std::ranges::count_if(spots, [&](const TableSpot& x) {
    return std::ranges::none_of(
      table, [&](const auto& y) { return std::hypot(x.x - y.x, x.y - y.y) < stands_right; });
  });
  EXPECT_EQ(moved, 1);
}

TEST(TableGroups, WhatStandsTogetherStays) {
  const std::vector<TableThing> table{group_member("a", -0.2, 0.1), group_member("b", -0.2, 0.0),
                                      group_member("c", 0.05, -0.1), group_member("d", 0.1, -0.01)};
  const auto spots = grouped({{&table[0], &table[1]}, {&table[2], &table[3]}}, TableRoom{table});
  ASSERT_EQ(spots.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(std::hypot(spots[i].x - table[i].x, spots[i].y - table[i].y), 0);
}

TEST(TableGroups, WhatIsInNoGroupStaysInNobodysWay) {
  const std::vector<TableThing> table{group_member("a", -0.2, 0.0), group_member("b", 0.2, 0.0),
                                      group_member("other", 0.1, 0.0, 0.05),
                                      group_member("c", 0.0, 0.15)};
  const std::vector<Group> groups{{&table[0], &table[1]}, {&table[3]}};
  const auto spots = grouped(groups, TableRoom{table});
  expect_together(groups, spots);
  for (const auto& x : spots)
    EXPECT_GT(std::hypot(x.x - 0.1, x.y), 0.08);
}

TEST(TableGroups, WhereNothingCanBePutThereAreNone) {
  const std::vector<TableThing> table{group_member("a", -0.2, 0.0), group_member("b", 0.0, 0.0),
                                      group_member("c", 0.2, 0.0)};
  const auto nowhere = [](const TableThing&, double, double) { return spatial::Reach::none; };
  EXPECT_TRUE(grouped({{&table[0], &table[2]}, {&table[1]}}, TableRoom{table, nowhere}).empty());
}

TEST(TableGroups, RandomTablesAreGrouped) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-0.25, 0.25);
  std::uniform_real_distribution<double> y(-0.17, 0.17);
  int found = 0;
  for (int round = 0; round < 30; ++round) {
    std::vector<TableThing> table;
    while (table.size() < 6) {
      const auto next =
        group_member("t" + std::to_string(table.size()), x(random), y(random), 0.028);
      if (std::ranges::all_of(table, [&](const auto& other) {
            return std::hypot(other.x - next.x, other.y - next.y) > 0.1;
          }))
        table.push_back(next);
    }
    const std::vector<Group> groups{
      {&table[0], &table[1], &table[2]}, {&table[3]}, {&table[4], &table[5]}};
    const auto spots = grouped(groups, TableRoom{table});
    if (spots.empty())
      continue;
    ++found;
    expect_together(groups, spots);
  }
  EXPECT_GE(found, 24);
}

} // namespace castor::planning
