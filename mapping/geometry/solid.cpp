#include "castor/mapping/geometry/solid.hpp"

#include "castor/mapping/geometry/poses.hpp"

#include <cmath>

namespace castor::geometry {

std::string to_string(SolidKind kind) {
  switch (kind) {
    case SolidKind::box:
      return "box";
    case SolidKind::cylinder:
      return "cylinder";
    case SolidKind::capsule:
      return "capsule";
    case SolidKind::sphere:
      return "sphere";
  }
  return {};
}

Solid box(double length, double width, double height) {
  return {SolidKind::box, {length, width, height}};
}

Solid cylinder(double diameter, double height) {
  return {SolidKind::cylinder, {diameter, diameter, height}};
}

Solid capsule(double diameter, double length) {
  return {SolidKind::capsule, {diameter, diameter, length}};
}

Solid sphere(double diameter) {
  return {SolidKind::sphere, {diameter, diameter, diameter}};
}

double outer_radius(const Solid& solid) {
  const auto& size = solid.size;
  switch (solid.kind) {
    case SolidKind::box:
      return std::hypot(size.x, size.y, size.z) / 2;
    case SolidKind::cylinder:
      return std::hypot(size.x, size.z) / 2;
    default:
      return size.z / 2;
  }
}

double half_height(const Solid& solid, const Rotation& rotation) {
  // z of the frame, as the solid sees it.
  const auto up = rotate(inverse(rotation), {0, 0, 1});
  const auto& size = solid.size;
  switch (solid.kind) {
    case SolidKind::box:
      return (std::abs(up.x) * size.x + std::abs(up.y) * size.y + std::abs(up.z) * size.z) / 2;
    case SolidKind::cylinder:
      return (std::hypot(up.x, up.y) * size.x + std::abs(up.z) * size.z) / 2;
    case SolidKind::capsule:
      return std::abs(up.z) * (size.z - size.x) / 2 + size.x / 2;
    default:
      return size.z / 2;
  }
}

} // namespace castor::geometry
