#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "castor/perception/vision/types.hpp"

/// A table with objects on it that come, move and go: what a rendered camera looks at, and the
/// ground truth of it.
namespace castor::vision {

/// An sRGB colour.
struct SceneColour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const SceneColour&, const SceneColour&) = default;
};

/// Solids, then flat pieces.
enum class TabletopShape { cube, box, cylinder, sphere, square, rectangle, triangle, disc };

/// The name as in a scene file: "cube", "box", ...
std::string_view to_string(TabletopShape shape);

/// Whether it is one of the flat pieces, a few millimetres thick.
bool is_flat(TabletopShape shape);

/// A thing that stands or lies on the table.
struct TabletopObject {
  /// What it is referred to by, if not by its colour and shape; may be empty.
  std::string name;
  /// As in the scene file: a common name, or "#rrggbb".
  std::string colour_name;
  SceneColour colour;
  TabletopShape shape = TabletopShape::cube;
  /// Where its middle is on the table; metres.
  double x = 0;
  double y = 0;
  /// How long it is along the axes of the table when not turned, and how high; metres. A triangle
  /// is equilateral with the side size.x, points away from the viewer when not turned, and its
  /// middle is its centroid.
  Point3 size;
  /// Anticlockwise as seen from above.
  double turned_degrees = 0;

  friend bool operator==(const TabletopObject&, const TabletopObject&) = default;
};

/// Where the object is: its middle, at half its height, and how it is turned.
Pose pose_of(const TabletopObject& object);

/// The smallest box along the table's axes that holds the object.
ObjectBox bounding_box(const TabletopObject& object);

/// The outline of what the object covers of the table, anticlockwise; a circle has 32 corners.
std::vector<Point2> footprint(const TabletopObject& object);

/// Whether two objects would be in the same place: their footprints overlap.
bool overlap(const TabletopObject& a, const TabletopObject& b);

/// What the table is made of.
struct TableLook {
  enum class Material { wood, cloth, plain };

  Material material = Material::wood;
  SceneColour colour{190, 166, 134};
  /// The extent along x and y, metres; the middle is the table's origin.
  double width = 2.0;
  double depth = 2.0;

  friend bool operator==(const TableLook&, const TableLook&) = default;
};

/// A scene as it is at one moment.
struct TabletopSnapshot {
  TableLook table;
  /// Where the lamp is; metres.
  Point3 light{-1, -1, 2};
  /// The standard deviation of the sensor's noise, in grey levels.
  double noise = 2;
  /// Of the noise.
  std::uint64_t seed = 1;
  std::vector<TabletopObject> objects;

  friend bool operator==(const TabletopSnapshot&, const TabletopSnapshot&) = default;
};

/// Time since the scene began.
using SceneTime = std::chrono::microseconds;

/// A straight move at constant speed from wherever the object is at `start`; instantaneous if
/// `duration` is zero. It ends early if the next move begins.
struct TabletopMove {
  SceneTime start{0};
  SceneTime duration{0};
  double x = 0;
  double y = 0;

  friend bool operator==(const TabletopMove&, const TabletopMove&) = default;
};

/// An object and its fate.
struct TabletopActor {
  /// As it first appears.
  TabletopObject object;
  SceneTime appears{0};
  /// The object is no longer there from then on; never, if empty.
  std::optional<SceneTime> disappears;
  /// Ordered by start.
  std::vector<TabletopMove> moves;

  bool is_there(SceneTime time) const;
  /// The object as it is at `time`, if it is there.
  TabletopObject at(SceneTime time) const;

  friend bool operator==(const TabletopActor&, const TabletopActor&) = default;
};

/// A scene over time.
struct TabletopScene {
  /// What stays as it is; its objects are empty.
  TabletopSnapshot setting;
  Camera camera;
  /// In the order in which the scene file mentions them, initial ones first.
  std::vector<TabletopActor> actors;

  /// The scene as it is at `time`; before zero it is as at zero.
  TabletopSnapshot at(SceneTime time) const;

  /// When something begins or ends to change, in order and without repetition, zero first.
  std::vector<SceneTime> change_times() const;
};

} // namespace castor::vision
