#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <vector>

/// What a simulated arm tells the camera that renders its table.
namespace castor::manipulation {

enum class ViewedShape : std::uint8_t { box, cylinder, sphere, triangle };

/// A thing, or a part of the arm.
struct ViewedBody {
  ViewedShape shape = ViewedShape::box;
  /// As of vision's scenes: extents along its axes, metres.
  geometry::Point3 size;
  /// Of its middle, in the table's frame.
  geometry::Pose pose;
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// All that is above the floor. Pulled; never an entry.
struct TableView {
  /// Differs from that of before if something has moved.
  std::uint64_t change = 0;
  /// When that is so, microseconds since the system began.
  std::int64_t time = 0;
  std::vector<ViewedBody> bodies;
};

CASTOR_REFLECT_ENUM(ViewedShape, box, cylinder, sphere, triangle)
CASTOR_REFLECT(ViewedBody, shape, size, pose, red, green, blue)
CASTOR_REFLECT(TableView, change, time, bodies)

} // namespace castor::manipulation
