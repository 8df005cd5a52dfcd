#pragma once

#include "castor/mapping/building/polygon.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A building to simulate robots in. Metres; x to the right and y up as seen from above, z upwards
/// from the floor. `line` is that of the building's file, 0 if there is none.
namespace castor::mapping {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

/// The colour of a common name, or of "#rrggbb"; lower case.
std::optional<Colour> colour_named(std::string_view word);
const std::vector<std::string>& colour_names();

/// An upright wall around the segment `middle`, from the floor to the building's height.
struct Wall {
  Segment middle;
  double thickness = 0.1;
  int line = 0;
};

/// An opening in a wall. Shut, it is an obstacle; open, there is nothing.
struct Door {
  std::string name;
  /// On the middle of the wall, once it is known; else of no length, where the file says.
  Segment opening;
  double width = 0.85;
  bool is_open = true;
  /// Index of the wall that it is in, once it is known.
  std::size_t wall = 0;
  int line = 0;
};

struct Room {
  std::string name;
  /// Such as kitchen or corridor; the name if the file does not say.
  std::string kind;
  /// A point in it.
  Point2 inside;
  /// Along the middle of its walls, anticlockwise, and blocks of other rooms in it; empty until it
  /// is known.
  Polygon outline;
  std::vector<Polygon> holes;
  /// Square metres.
  double area = 0;
  int line = 0;
};

enum class SolidShape : std::uint8_t { box, disc };

/// An upright box, turned about z, or an upright cylinder.
struct Solid {
  SolidShape shape = SolidShape::box;
  /// Of its middle.
  Pose2 pose;
  /// Along the x and y axes of its pose; both the diameter of a disc.
  double length = 0;
  double width = 0;
  /// Above the floor.
  double bottom = 0;
  double top = 0;
  Colour colour;
};

struct Furniture {
  std::string name;
  std::string kind;
  /// As a whole. With legs, it is solid only near its top and at the legs.
  Solid body;
  bool has_legs = false;
  int line = 0;
};

/// A thing that a robot may look for.
struct BuildingObject {
  std::string name;
  std::string kind;
  Solid body;
  int line = 0;
};

/// Somebody who walks along a route.
struct Walker {
  std::string name;
  /// At least two points.
  std::vector<Point2> route;
  /// Whether the route goes on at its first point after the last; if not, the person walks back.
  bool is_loop = false;
  /// Metres per second.
  double speed = 0.8;
  /// Stands that long at each point of the route, seconds.
  double pause = 0;
  /// Who shows a robot around walks slower from half that distance from it on, and does not leave
  /// it farther behind, metres; 0: walks on.
  double leads_within = 0;
  double radius = 0.25;
  int line = 0;
};

struct Building {
  std::string name;
  /// Of walls and doors.
  double height = 2.5;
  std::vector<Wall> walls;
  std::vector<Door> doors;
  std::vector<Room> rooms;
  std::vector<Furniture> furniture;
  std::vector<BuildingObject> objects;
  std::vector<Walker> people;
  /// Where the robot begins.
  Pose2 start;
  int start_line = 0;
};

/// Lower left and upper right corner of what the walls and furniture take; both zero without any.
struct Extent {
  Point2 low;
  Point2 high;
};
Extent extent(const Building& x);

/// Null if no room is there.
const Room* room_at(const Building& x, const Point2& p);

/// Where the person is after walking that far, or backwards if it is negative; goes on for ever.
Point2 place_on_route(const Walker& x, double walked);

/// Length of the route until it begins again, metres.
double round_length(const Walker& x);

/// Number of points of the route that the person has come to after walking that far, those of all
/// rounds; less than 0 for one who walked backwards.
std::int64_t points_reached(const Walker& x, double walked);

} // namespace castor::mapping
