#include "castor/perception/vision/tabletop/tabletop_renderer_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace castor::vision {

namespace {

/// A random number in [0, 1) for each lattice point; not as well mixed as mixed(), but good enough
/// for the eye and half the work.
double lattice(std::int64_t x, std::int64_t y) {
  std::uint64_t hash = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15 ^
                       static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4F;
  hash = (hash ^ (hash >> 32)) * 0xD6E8FEB86659FD93;
  return static_cast<double>(hash >> 33) * 0x1p-31;
}

double mix(double a, double b, double t) {
  return a + t * (b - a);
}

/// Smooth noise about zero in [-0.5, 0.5] with features of the size 1.
double noise(double x, double y) {
  // Conversion cuts off towards zero; this is several times faster than std::floor.
  const auto i = static_cast<std::int64_t>(x) - (x < 0);
  const auto j = static_cast<std::int64_t>(y) - (y < 0);
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double u = smooth(x - static_cast<double>(i));
  const double v = smooth(y - static_cast<double>(j));
  return mix(mix(lattice(i, j), lattice(i + 1, j), u),
             mix(lattice(i, j + 1), lattice(i + 1, j + 1), u), v) -
         0.5;
}

/// 1 for a pattern with details of the size `detail` that are well resolved, down to 0 for one that
/// a pixel averages out.
double resolved(double detail, double footprint) {
  return std::clamp(2 - 2 * footprint / detail, 0.0, 1.0);
}

} // namespace

TableTexture::TableTexture(const TableLook& look)
  : material_(look.material), colour_(to_linear(look.colour)) {
  // nop
}

LinearColour TableTexture::at(double x, double y, double footprint) const {
  switch (material_) {
    case TableLook::Material::wood: {
      // Where wood is darker it is also a little redder.
      const double tone = wood(x, y, footprint);
      return {colour_.red * (1 + 0.9 * (tone - 1)), colour_.green * tone,
              colour_.blue * (1 + 1.1 * (tone - 1))};
    }
    case TableLook::Material::cloth:
      return cloth(x, y, footprint) * colour_;
    case TableLook::Material::plain:
      break;
  }
  return (1 + 0.03 * noise(3 * x, 3 * y)) * colour_;
}

double TableTexture::wood(double x, double y, double footprint) const {
  constexpr double board_width = 0.16;
  constexpr double joint_width = 0.0012;
  const double board = std::floor(y / board_width);
  const auto number = static_cast<std::int64_t>(board);
  const double own = lattice(number, 17);
  // Each board is cut from another part of a tree.
  const double u = x + 7 * own;
  const double v = y + 3 * lattice(number, 29);
  const double bent = v + 0.03 * noise(1.1 * u, 6 * v) + 0.006 * noise(5 * u, 20 * v);
  double tone = 1 + 0.10 * (own - 0.5);
  tone += 0.12 * noise(1.5 * u, 28 * bent);
  tone += 0.05 * std::sin(2 * std::numbers::pi * (32 * bent + 3 * noise(0.7 * u, 5 * bent)));
  if (const double weight = resolved(0.007, footprint); weight > 0)
    tone += weight * 0.10 * noise(6 * u, 140 * bent);
  if (const double weight = resolved(0.0025, footprint); weight > 0)
    tone += weight * 0.08 * noise(15 * u, 420 * bent);
  const double to_joint = std::min(y - board * board_width, (board + 1) * board_width - y);
  const double half_width = std::max(joint_width, footprint) / 2;
  const double cover = std::clamp(1 - to_joint / (2 * half_width), 0.0, 1.0);
  return tone * (1 - 0.45 * cover * joint_width / (2 * half_width));
}

double TableTexture::cloth(double x, double y, double footprint) const {
  constexpr double thread = 0.003;
  double tone = 1 + 0.08 * noise(4 * x + 1.5 * y, 5 * y) + 0.06 * noise(60 * x, 60 * y);
  if (const double weight = resolved(thread, footprint); weight > 0)
    tone += weight * 0.10 * std::sin(2 * std::numbers::pi * x / thread) *
            std::sin(2 * std::numbers::pi * y / thread);
  if (const double weight = resolved(0.006, footprint); weight > 0)
    tone += weight * 0.10 * noise(x / 0.004, y / 0.004);
  return tone;
}

} // namespace castor::vision
