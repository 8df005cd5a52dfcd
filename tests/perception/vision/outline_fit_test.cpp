#include "castor/perception/vision/recognition/outline_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/recognition/outline_models.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

namespace castor::vision {

using namespace geometry;
namespace {

Camera camera() {
  return look_at({0, -0.8, 0.55}, {0, 0, 0}, 38, 320, 240);
}

double measurement_of(const std::vector<double>& fit, const std::string& name) {
  const auto& names = fit_measurements();
  const auto found = std::find(names.begin(), names.end(), name);
  EXPECT_NE(found, names.end()) << name;
  return fit.at(static_cast<std::size_t>(found - names.begin()));
}

std::vector<double> fit_of(TabletopShape shape, double height) {
  TabletopSnapshot scene;
  scene.table.material = TableLook::Material::plain;
  scene.table.colour = {200, 200, 200};
  TabletopObject object;
  object.shape = shape;
  object.colour = {40, 70, 190};
  object.size = {0.09, 0.09, height};
  object.turned_degrees = 30;
  scene.objects = {object};
  const auto regions = find_regions(render(scene, camera()));
  // A shadow may be taken for a smaller thing.
  const auto largest =
    std::max_element(regions.begin(), regions.end(), [](const Region& a, const Region& b) {
      return a.roi.contour.size() < b.roi.contour.size();
    });
  return measure_fit(largest->roi, camera());
}

TEST(Support, reaches_to_the_outermost_points) {
  const Support support = support_of({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  EXPECT_NEAR(support[0], 4, 1e-9);
  // The image's y axis points down.
  EXPECT_NEAR(support[6], 0, 1e-9);
  EXPECT_NEAR(support[12], 0, 1e-9);
  EXPECT_NEAR(support[18], 2, 1e-9);
}

TEST(Alignment, finds_scale_and_shift) {
  const std::vector<Point2> points{{0, 0}, {10, 0}, {10, 4}, {0, 8}};
  std::vector<Point2> moved;
  for (const auto& point : points)
    moved.push_back({1.5 * point.x + 20, 1.5 * point.y - 7});
  const Alignment alignment = align(support_of(points), support_of(moved), 1);
  EXPECT_NEAR(alignment.scale, 1.5, 1e-6);
  EXPECT_NEAR(alignment.shift.x, 20, 1e-6);
  EXPECT_NEAR(alignment.shift.y, -7, 1e-6);
  EXPECT_NEAR(alignment.deviation, 0, 1e-6);
}

TEST(Alignment, is_not_misled_by_a_hidden_part) {
  std::vector<Point2> disc;
  std::vector<Point2> visible;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * std::numbers::pi / 180;
    disc.push_back({std::cos(angle), std::sin(angle)});
    const Point2 pixel{30 + 20 * std::cos(angle), 30 + 20 * std::sin(angle)};
    if (pixel.y < 40)
      visible.push_back(pixel);
  }
  const Alignment alignment = align(support_of(disc), support_of(visible), 1.5);
  EXPECT_NEAR(alignment.scale, 20, 0.5);
  EXPECT_NEAR(alignment.shift.y, 30, 0.5);
}

TEST(OutlineModel, has_the_faces_in_view) {
  const Stand stand{0, 0, 0.1};
  const auto turned = model_box(camera(), stand, std::numbers::pi / 4, 1);
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->faces.size(), 3U);
  ASSERT_EQ(turned->upright.size(), 2U);
  EXPECT_GT(turned->upright[0].y, turned->upright[1].y);
  EXPECT_EQ(turned->rim.size(), 3U);
  const auto straight = model_box(camera(), stand, 0, 1);
  ASSERT_TRUE(straight);
  EXPECT_EQ(straight->faces.size(), 2U);
  EXPECT_TRUE(straight->upright.empty());
  EXPECT_FALSE(model_box(camera(), {0, -2, 0.1}, 0, 1));
}

TEST(OutlineFit, is_best_for_the_shape_itself) {
  const auto cube = fit_of(TabletopShape::cube, 0.09);
  EXPECT_LT(measurement_of(cube, "fit_cube"), measurement_of(cube, "fit_cylinder"));
  EXPECT_LT(measurement_of(cube, "fit_cube"), measurement_of(cube, "fit_sphere"));
  EXPECT_GT(measurement_of(cube, "faces_cube"), 0.8);
  EXPECT_GT(measurement_of(cube, "edge_upright"), 0.05);
  const auto cylinder = fit_of(TabletopShape::cylinder, 0.09);
  EXPECT_LT(measurement_of(cylinder, "fit_cylinder"), measurement_of(cylinder, "fit_cube"));
  const auto sphere = fit_of(TabletopShape::sphere, 0.09);
  EXPECT_LT(measurement_of(sphere, "fit_sphere"), measurement_of(sphere, "fit_cube"));
  EXPECT_LT(measurement_of(sphere, "fit_sphere"), measurement_of(sphere, "fit_circle"));
  const auto disc = fit_of(TabletopShape::disc, 0.005);
  EXPECT_LT(measurement_of(disc, "fit_circle"), measurement_of(disc, "fit_sphere"));
}

TEST(OutlineFit, is_nothing_above_the_horizon) {
  ROI roi;
  roi.box = {{100, 4}, 9, 9};
  roi.mask = Image{9, 9, 1, std::vector<std::uint8_t>(81, 255)};
  roi.region = Image{9, 9, 3, std::vector<std::uint8_t>(243, 99)};
  roi.contour = {{96, 0}, {104, 0}, {104, 8}, {96, 8}};
  const auto fit = measure_fit(roi, look_at({0, -0.8, 0.3}, {0, 0, 0.4}, 40, 320, 240));
  EXPECT_EQ(fit, std::vector<double>(fit_measurements().size(), 0));
}

} // namespace
} // namespace castor::vision
