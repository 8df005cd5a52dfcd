#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/grid_obstacles.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <random>

namespace castor::mapping {

namespace {

using std::numbers::pi;

Solid box(double x, double y, double heading, double length, double width) {
  return {SolidShape::box, {x, y, heading}, length, width, 0, 1, {}};
}

Solid disc(double x, double y, double diameter) {
  return {SolidShape::disc, {x, y, 0}, diameter, diameter, 0, 1, {}};
}

double metres(int x) {
  return x / 1000.0;
}

std::vector<Solid> random_solids() {
  std::vector<Solid> result;
  const auto count = *rc::gen::inRange(0, 30);
  for (int i = 0; i < count; ++i) {
    const auto x = metres(*rc::gen::inRange(-10000, 10000));
    const auto y = metres(*rc::gen::inRange(-10000, 10000));
    const auto length = metres(*rc::gen::inRange(10, 5000));
    if (*rc::gen::arbitrary<bool>())
      result.push_back(disc(x, y, length));
    else
      result.push_back(
        box(x, y, *rc::gen::inRange(0, 8) * pi / 8, length, metres(*rc::gen::inRange(10, 1000))));
  }
  return result;
}

Point2 random_point() {
  return {metres(*rc::gen::inRange(-13000, 13000)), metres(*rc::gen::inRange(-13000, 13000))};
}

/// The nearest hit of each solid by itself: without neighbours, no index can leave it out.
std::optional<double> cast_one_by_one(const std::vector<Solid>& solids, const Point2& origin,
                                      double direction, double max_range) {
  std::optional<double> result;
  for (auto& x : solids) {
    auto hit = SolidObstacles(std::span(&x, 1), 100).cast(origin, direction, max_range);
    if (hit && (!result || *hit < *result))
      result = hit;
  }
  return result;
}

bool is_inside(const Solid& x, const Point2& p) {
  auto own = transform(inverse(x.pose), p);
  return x.shape == SolidShape::disc
           ? std::hypot(own.x, own.y) <= x.length / 2
           : std::abs(own.x) <= x.length / 2 && std::abs(own.y) <= x.width / 2;
}

} // namespace

TEST(SolidObstacles, HitsTheSideOfABox) {
  const std::vector<Solid> solids{box(5, 0, 0, 2, 4)};
  const SolidObstacles obstacles(solids);
  EXPECT_NEAR(obstacles.cast({0, 0}, 0, 10).value(), 4, 1e-12);
  // Obliquely: 4 m across at 20 degrees.
  EXPECT_NEAR(obstacles.cast({0, 0}, 20 * pi / 180, 10).value(), 4 / std::cos(20 * pi / 180),
              1e-12);
  EXPECT_FALSE(obstacles.cast({0, 0}, 30 * pi / 180, 10)) << "2.31 m aside at 4 m";
  EXPECT_FALSE(obstacles.cast({0, 0}, pi, 10));
  EXPECT_FALSE(obstacles.cast({0, 0}, 0, 3.9));
  EXPECT_EQ(obstacles.cast({5, 1}, 1, 10), 0.0) << "begins in it";
}

TEST(SolidObstacles, HitsATurnedBox) {
  // A square on its corner: half of its diagonal nearer than its middle.
  const std::vector<Solid> solids{box(5, 0, pi / 4, 2, 2)};
  const SolidObstacles obstacles(solids);
  EXPECT_NEAR(obstacles.cast({0, 0}, 0, 10).value(), 5 - std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(obstacles.cast({0, 0.5}, 0, 10).value(), 5.5 - std::sqrt(2.0), 1e-12);
}

TEST(SolidObstacles, HitsADisc) {
  const std::vector<Solid> solids{disc(0, 3, 2)};
  const SolidObstacles obstacles(solids);
  EXPECT_NEAR(obstacles.cast({0, 0}, pi / 2, 10).value(), 2, 1e-12);
  EXPECT_NEAR(obstacles.cast({0.6, 0}, pi / 2, 10).value(), 3 - 0.8, 1e-12);
  EXPECT_FALSE(obstacles.cast({1.01, 0}, pi / 2, 10));
}

TEST(SolidObstacles, KnowsTheDistanceToTheNearest) {
  const std::vector<Solid> solids{box(5, 0, 0, 2, 4), disc(0, 3, 2)};
  const SolidObstacles obstacles(solids);
  EXPECT_NEAR(obstacles.clearance({0, 0}, 10), 2, 1e-12);
  EXPECT_NEAR(obstacles.clearance({7, 5}, 10), std::hypot(1, 3), 1e-12) << "from a corner";
  EXPECT_EQ(obstacles.clearance({5, 1}, 10), 0);
  EXPECT_EQ(obstacles.clearance({0, 0}, 1.5), 1.5);
  EXPECT_EQ(obstacles.clearance({100, 100}, 1.5), 1.5);
}

TEST(SolidObstacles, WithoutAnyNothingIsInTheWay) {
  const SolidObstacles obstacles({});
  EXPECT_FALSE(obstacles.cast({0, 0}, 0, 10));
  EXPECT_EQ(obstacles.clearance({0, 0}, 1), 1);
}

RC_GTEST_PROP(SolidObstacles, IndexLeavesNothingOut, ()) {
  const auto solids = random_solids();
  const auto cell = *rc::gen::element(0.05, 0.5, 3.0);
  const SolidObstacles obstacles(solids, cell);
  for (int i = 0; i < 20; ++i) {
    const auto origin = random_point();
    // Along the axes too, where rays go along the borders of cells.
    const double direction = *rc::gen::arbitrary<bool>() ? *rc::gen::inRange(-4, 5) * pi / 4
                                                         : metres(*rc::gen::inRange(-4000, 4000));
    const auto found = obstacles.cast(origin, direction, 15);
    const auto wanted = cast_one_by_one(solids, origin, direction, 15);
    RC_ASSERT(found.has_value() == wanted.has_value());
    if (found)
      RC_ASSERT(std::abs(*found - *wanted) < 1e-9);
  }
}

RC_GTEST_PROP(SolidObstacles, RaysEndWhereObstaclesBegin, ()) {
  const auto solids = random_solids();
  const SolidObstacles obstacles(solids);
  const auto origin = random_point();
  const auto direction = metres(*rc::gen::inRange(-4000, 4000));
  const auto found = obstacles.cast(origin, direction, 30);
  auto at = [&](double way) {
    return Point2{origin.x + way * std::cos(direction), origin.y + way * std::sin(direction)};
  };
  auto is_in_any = [&](const Point2& p) {
    return std::any_of(solids.begin(), solids.end(), [&](auto& x) { return is_inside(x, p); });
  };
  for (double way = 0; way < found.value_or(30) - 1e-6; way += 0.01)
    RC_ASSERT(!is_in_any(at(way)));
  if (found) {
    RC_ASSERT(obstacles.clearance(at(*found), 1) < 1e-9);
    RC_ASSERT(obstacles.clearance(origin, 40) <= *found + 1e-9);
  }
}

TEST(Disc, IsHitAsAMovingObstacle) {
  const Disc person{{3, 0}, 0.25};
  EXPECT_NEAR(cast(person, {0, 0}, 0, 10).value(), 2.75, 1e-12);
  EXPECT_FALSE(cast(person, {0, 0}, pi, 10));
  EXPECT_FALSE(cast(person, {0, 0}, 0, 2));
  EXPECT_EQ(cast(person, {3.1, 0}, 2, 10), 0.0);
  const SolidObstacles nothing({});
  EXPECT_NEAR(clearance(nothing, std::span(&person, 1), {0, 0}, 10), 2.75, 1e-12);
}

TEST(GridObstacles, HitsTheNearSideOfACell) {
  // Columns 0 to 9, rows 0 to 4, 0.5 m each, from -1 -1; one occupied at column 6, row 2.
  std::vector<std::uint8_t> cells(50);
  cells[2 * 10 + 6] = 1;
  const GridObstacles grid(cells, 10, 5, 0.5, {-1, -1});
  EXPECT_NEAR(grid.cast({0, 0.2}, 0, 10).value(), 2, 1e-12);
  EXPECT_NEAR(grid.cast({2.2, -3}, pi / 2, 10).value(), 3, 1e-12) << "from outside";
  EXPECT_FALSE(grid.cast({0, 0.2}, pi, 10));
  EXPECT_FALSE(grid.cast({0, 0.2}, 0, 1.9));
  EXPECT_NEAR(grid.clearance({0, 0.2}, 5), 2, 1e-12);
  EXPECT_EQ(grid.clearance({2.2, 0.2}, 5), 0);
  EXPECT_THROW(GridObstacles(cells, 10, 6, 0.5, {0, 0}), std::invalid_argument);
}

RC_GTEST_PROP(GridObstacles, IsLikeBoxesOfThatSize, ()) {
  std::vector<std::uint8_t> cells(100);
  std::vector<Solid> solids;
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column)
      if (*rc::gen::inRange(0, 6) == 0) {
        cells[static_cast<std::size_t>(row * 10 + column)] = 1;
        solids.push_back(box(column + 0.5, row + 0.5, 0, 1, 1));
      }
  const GridObstacles grid(cells, 10, 10, 1, {0, 0});
  const SolidObstacles boxes(solids);
  const auto origin = random_point();
  // Not through corners, where either answer is right.
  const auto direction = metres(*rc::gen::inRange(-4000, 4000)) + 1e-4;
  const auto a = grid.cast(origin, direction, 20);
  const auto b = boxes.cast(origin, direction, 20);
  RC_ASSERT(a.has_value() == b.has_value());
  if (a)
    RC_ASSERT(std::abs(*a - *b) < 1e-9);
  RC_ASSERT(std::abs(grid.clearance(origin, 3) - boxes.clearance(origin, 3)) < 1e-9);
}

TEST(SolidObstacles, SweepOfTheOfficeIsFast) {
  auto office = load_building(CASTOR_CONFIGS "/buildings/office.building").building;
  const SolidObstacles obstacles(between_heights(solids_of(office), 0.3, 0.3));
  constexpr int sweeps = 2000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(0.5, 17.5);
  std::size_t hits = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < sweeps; ++i) {
    const Point2 origin{along(random), 5.1};
    for (int beam = 0; beam < 360; ++beam)
      hits += obstacles.cast(origin, beam * pi / 180, 20).has_value();
  }
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
  std::cout << "360 beams take " << time.count() / sweeps << " us\n";
  EXPECT_EQ(hits, sweeps * 360u) << "the office is closed";
  // Far above what it takes, so that a busy machine does not matter.
  EXPECT_LT(time.count() / sweeps, 1000);
}

} // namespace castor::mapping
