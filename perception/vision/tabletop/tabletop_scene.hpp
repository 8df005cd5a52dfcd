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

/// A table with objects that appear, move and disappear: the scene of a rendered camera, and its
/// ground truth.
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

/// An object on the table.
struct TabletopObject {
  /// Name for references; if empty, it is referred to by colour and shape.
  std::string name;
  /// As in the scene file: a common name, or "#rrggbb".
  std::string colour_name;
  SceneColour colour;
  TabletopShape shape = TabletopShape::cube;
  /// Position of its middle on the table; metres.
  double x = 0;
  double y = 0;
  /// Extent along the axes of the table when not turned, and height; metres. A triangle is
  /// equilateral with the side size.x, points away from the viewer when not turned, and its middle
  /// is its centroid.
  Point3 size;
  /// Anticlockwise as seen from above.
  double turned_degrees = 0;

  friend bool operator==(const TabletopObject&, const TabletopObject&) = default;
};

/// Pose of the object: its middle, at half its height, and its rotation.
Pose pose_of(const TabletopObject& object);

/// The smallest box along the table's axes that holds the object.
AlignedBox bounding_box(const TabletopObject& object);

/// Outline of the object on the table, anticlockwise; a circle has 32 corners.
std::vector<Point2> footprint(const TabletopObject& object);

/// Whether the footprints of two objects overlap.
bool overlap(const TabletopObject& a, const TabletopObject& b);

/// An object that need not stand upright on the table: one that is carried or stands on another
/// one, or a part of an arm.
struct PlacedObject {
  /// Its position and its turn mean nothing.
  TabletopObject object;
  /// Of its middle, at half its height.
  Pose pose;

  friend bool operator==(const PlacedObject&, const PlacedObject&) = default;
};

/// Material, size and colour of the table.
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
  /// Position of the lamp; metres.
  Point3 light{-1, -1, 2};
  /// The standard deviation of the sensor's noise, in grey levels.
  double noise = 2;
  /// Seed of the noise.
  std::uint64_t seed = 1;
  std::vector<TabletopObject> objects;
  /// Further ones, wherever they are.
  std::vector<PlacedObject> placed{};

  friend bool operator==(const TabletopSnapshot&, const TabletopSnapshot&) = default;
};

/// Time since the scene began.
using SceneTime = std::chrono::microseconds;

/// A straight move at constant speed from the object's position at `start`; instantaneous if
/// `duration` is zero. It ends early if the next move begins.
struct TabletopMove {
  SceneTime start{0};
  SceneTime duration{0};
  double x = 0;
  double y = 0;

  friend bool operator==(const TabletopMove&, const TabletopMove&) = default;
};

/// An object and its changes over time.
struct TabletopActor {
  /// Initial state.
  TabletopObject object;
  SceneTime appears{0};
  /// Time of its removal; empty for never.
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
  /// Constant part of the scene; has no objects.
  TabletopSnapshot setting;
  Camera camera;
  /// In the order in which the scene file mentions them, initial ones first.
  std::vector<TabletopActor> actors;

  /// The scene as it is at `time`; before zero it is as at zero.
  TabletopSnapshot at(SceneTime time) const;

  /// Times at which a change begins or ends, in order and without repetition, zero first.
  std::vector<SceneTime> change_times() const;
};

} // namespace castor::vision
