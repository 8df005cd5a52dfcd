#include "castor/mapping/body/scene_camera.hpp"

#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/scene_rays.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/geometry/camera_model.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace castor::mapping {

namespace {

using std::numbers::pi;

CameraOptions exact_camera() {
  CameraOptions result;
  result.depth_noise = 0;
  result.colour_noise = 0;
  result.ahead = 0;
  return result;
}

/// A red wall whose near side is at x = 4, as high as the ceiling.
std::vector<Solid> red_wall() {
  return {{SolidShape::box, {4.5, 0, 0}, 1, 100, 0, 2.5, {200, 0, 0}}};
}

std::size_t index_of(int column, int row) {
  return static_cast<std::size_t>(row * 160 + column);
}

double thousandths(int x) {
  return x / 1000.0;
}

bool is_within(const Solid& x, const geometry::Point3& p) {
  if (p.z < x.bottom || p.z > x.top)
    return false;
  const auto own = transform(inverse(x.pose), Point2{p.x, p.y});
  return x.shape == SolidShape::disc
           ? std::hypot(own.x, own.y) <= x.length / 2
           : std::abs(own.x) <= x.length / 2 && std::abs(own.y) <= x.width / 2;
}

} // namespace

TEST(SceneSlice, HitsSidesTopsAndFloor) {
  const std::vector<Solid> solids{{SolidShape::box, {4, 0, 0}, 2, 2, 0, 0.5, {}},
                                  {SolidShape::disc, {8, 0, 0}, 2, 2, 0, 3, {}}};
  const SceneSlice slice(solids, {0, 0}, 0, 20, 2.5);
  auto level = slice.first(0.3, 0);
  ASSERT_TRUE(level && level->solid);
  EXPECT_NEAR(level->along, 3, 1e-12);
  EXPECT_EQ(level->face, SolidFace::side);
  // Over the edge of the box, onto its top: from 1 m to 0.5 m in 3.5 m.
  auto top = slice.first(1, -0.5 / 3.5);
  ASSERT_TRUE(top && top->solid);
  EXPECT_EQ(*top->solid, 0u);
  EXPECT_EQ(top->face, SolidFace::top);
  EXPECT_NEAR(top->along, 3.5, 1e-12);
  auto over = slice.first(1, 0);
  ASSERT_TRUE(over && over->solid);
  EXPECT_EQ(*over->solid, 1u);
  EXPECT_NEAR(over->along, 7, 1e-12);
  auto floor = slice.first(1, -1);
  ASSERT_TRUE(floor);
  EXPECT_FALSE(floor->solid);
  EXPECT_NEAR(floor->along, 1, 1e-12);
  auto ceiling = slice.first(1, 1);
  ASSERT_TRUE(ceiling);
  EXPECT_EQ(ceiling->face, SolidFace::bottom);
  EXPECT_NEAR(ceiling->along, 1.5, 1e-12);
}

RC_GTEST_PROP(SceneSlice, FirstHitIsWhereARayFirstIsWithinSomething, ()) {
  std::vector<Solid> solids;
  const auto count = *rc::gen::inRange(0, 12);
  for (int i = 0; i < count; ++i) {
    const double bottom = thousandths(*rc::gen::inRange(0, 2000));
    solids.push_back({*rc::gen::arbitrary<bool>() ? SolidShape::box : SolidShape::disc,
                      {thousandths(*rc::gen::inRange(-5000, 5000)),
                       thousandths(*rc::gen::inRange(-5000, 5000)), *rc::gen::inRange(0, 6) * 0.5},
                      thousandths(*rc::gen::inRange(100, 2000)),
                      thousandths(*rc::gen::inRange(100, 2000)),
                      bottom,
                      bottom + thousandths(*rc::gen::inRange(50, 1000)),
                      {}});
  }
  const double height = thousandths(*rc::gen::inRange(100, 2400));
  const double direction = thousandths(*rc::gen::inRange(-3000, 3000));
  const double slope = thousandths(*rc::gen::inRange(-800, 800));
  const Point2 eye{thousandths(*rc::gen::inRange(-6000, 6000)),
                   thousandths(*rc::gen::inRange(-6000, 6000))};
  const auto hit = SceneSlice(solids, eye, direction, 12, 2.5).first(height, slope);
  const double end = hit ? hit->along : 12;
  auto at = [&](double along) {
    return geometry::Point3{eye.x + along * std::cos(direction),
                            eye.y + along * std::sin(direction), height + slope * along};
  };
  for (double along = 0; along < end - 1e-6; along += 0.01) {
    RC_ASSERT(at(along).z > -1e-9 && at(along).z < 2.5 + 1e-9);
    RC_ASSERT(
      std::none_of(solids.begin(), solids.end(), [&](auto& x) { return is_within(x, at(along)); }));
  }
  if (hit && hit->solid) {
    auto a_little_larger = solids[*hit->solid];
    a_little_larger.bottom -= 1e-6;
    a_little_larger.top += 1e-6;
    a_little_larger.length += 2e-6;
    a_little_larger.width += 2e-6;
    RC_ASSERT(is_within(a_little_larger, at(end)));
  }
}

TEST(SceneCamera, SeesTheDepthOfAWall) {
  SceneCamera camera(exact_camera(), 1);
  auto view = camera.look(red_wall(), {}, 2.5, {});
  ASSERT_EQ(view.depths.size(), 160u * 120u);
  ASSERT_EQ(view.colours.size(), 3u * 160u * 120u);
  // Depths are along the axis, so that they are the same in all columns.
  for (int column : {0, 40, 80, 159})
    EXPECT_NEAR(view.depths[index_of(column, 60)], 4, 1e-5) << column;
  EXPECT_EQ(view.colours[3 * index_of(80, 60)], 0) << "blue";
  EXPECT_GT(view.colours[3 * index_of(80, 60) + 2], 140) << "red";
  // Below it is the floor, which is nearer.
  EXPECT_LT(view.depths[index_of(80, 119)], 2);
  EXPECT_GT(view.depths[index_of(80, 119)], 1);
}

TEST(SceneCamera, DoesNotMeasureWhatIsFar) {
  auto options = exact_camera();
  options.max_range = 3;
  SceneCamera camera(options, 1);
  auto view = camera.look(red_wall(), {}, 2.5, {});
  EXPECT_EQ(view.depths[index_of(80, 60)], 0);
  EXPECT_GT(view.colours[3 * index_of(80, 60) + 2], 140) << "but sees it";
}

TEST(SceneCamera, ItsModelProjectsItsPoints) {
  auto options = exact_camera();
  options.ahead = 0.2;
  SceneCamera camera(options, 1);
  auto office = load_building(CASTOR_CONFIGS "/buildings/office.building").building;
  auto view = camera.look(solids_of(office), {}, office.height, office.start);
  auto points = camera.points_of(view);
  auto model = camera.model();
  std::size_t next = 0;
  for (int row = 0; row < 120; ++row)
    for (int column = 0; column < 160; ++column) {
      if (!(view.depths[index_of(column, row)] > 0))
        continue;
      ASSERT_LE(next + 3, points.size());
      const geometry::Point3 point{points[next], points[next + 1], points[next + 2]};
      next += 3;
      auto seen = geometry::project(model, point);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(seen->x, column, 0.01);
      EXPECT_NEAR(seen->y, row, 0.01);
      EXPECT_GT(point.z, -0.01) << "nothing is below the floor";
      EXPECT_LT(point.z, office.height + 0.01);
    }
  EXPECT_EQ(next, points.size());
  EXPECT_GT(next, 3u * 10'000u);
}

TEST(SceneCamera, SeesPeopleAndWhereItLooks) {
  SceneCamera camera(exact_camera(), 1);
  const std::vector<Disc> people{{{0, 2}, 0.25}};
  auto ahead = camera.look(red_wall(), people, 2.5, {});
  EXPECT_NEAR(ahead.depths[index_of(80, 60)], 4, 1e-5);
  auto aside = camera.look(red_wall(), people, 2.5, {0, 0, pi / 2});
  EXPECT_NEAR(aside.depths[index_of(80, 60)], 1.75, 1e-3);
}

TEST(SceneCamera, DepthNoiseGrowsWithTheSquare) {
  auto options = exact_camera();
  options.depth_noise = 0.002;
  SceneCamera camera(options, 1);
  double squares = 0;
  int count = 0;
  auto view = camera.look(red_wall(), {}, 2.5, {});
  for (int row = 50; row < 70; ++row)
    for (int column = 0; column < 160; ++column) {
      squares += std::pow(view.depths[index_of(column, row)] - 4, 2);
      ++count;
    }
  EXPECT_NEAR(std::sqrt(squares / count), 0.002 * 16, 0.002);
}

TEST(SceneCamera, RefusesImpossibleOptions) {
  auto options = exact_camera();
  options.horizontal_fov = 180;
  EXPECT_THROW(SceneCamera(options, 1), std::invalid_argument);
  options = exact_camera();
  options.width = 0;
  EXPECT_THROW(SceneCamera(options, 1), std::invalid_argument);
}

} // namespace castor::mapping
