#include "castor/perception/vision/segmentation/size_limits.hpp"

#include <gtest/gtest.h>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

namespace castor::vision {

using namespace geometry;
namespace {

TabletopObject piece(double x, double side) {
  TabletopObject object;
  object.shape = TabletopShape::square;
  object.colour = {30, 60, 190};
  object.x = x;
  object.size = {side, side, 0.003};
  return object;
}

/// Squares with sides of 1, 2 and 9 cm on a grey sheet.
Image table_with_small_things(const Camera& camera) {
  TabletopSnapshot scene;
  scene.table.material = TableLook::Material::plain;
  scene.table.colour = {200, 200, 200};
  scene.objects = {piece(-0.15, 0.01), piece(-0.05, 0.02), piece(0.1, 0.09)};
  return render(scene, camera);
}

std::size_t count(const Camera& camera, const SizeLimits& limits) {
  return segment_table(table_with_small_things(camera), &camera, limits).size();
}

const Camera above_table = look_at({0, -0.62, 0.55}, {0, 0.03, 0}, 42, 640, 480);

TEST(SizeLimits, let_things_of_a_centimetre_pass_where_the_camera_is_calibrated) {
  EXPECT_EQ(count(above_table, {}), 3U);
}

TEST(SizeLimits, are_lengths_on_the_table) {
  SizeLimits limits;
  limits.min_length = 0.015;
  EXPECT_EQ(count(above_table, limits), 2U);
  limits.min_length = 0.04;
  EXPECT_EQ(count(above_table, limits), 1U);
}

TEST(SizeLimits, are_pixels_where_the_camera_is_unknown_or_assumed) {
  const Image image = table_with_small_things(above_table);
  EXPECT_EQ(segment_table(image, nullptr).size(), 2U);
  const Camera assumed = nominal_camera(640, 480);
  EXPECT_EQ(segment_table(image, &assumed).size(), 2U);
}

TEST(SizeLimits, are_a_share_of_the_picture_if_that_is_set) {
  SizeLimits limits;
  limits.min_area = 0.005;
  EXPECT_EQ(count(above_table, limits), 1U);
  limits.min_area = 0.0001;
  EXPECT_EQ(count(above_table, limits), 3U);
}

} // namespace
} // namespace castor::vision
