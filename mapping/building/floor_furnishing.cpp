#include "castor/mapping/building/floor_furnishing.hpp"

#include "castor/mapping/building/building_check.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// What a passage has to have beside the middle of the robot, metres: more than its radius, since
/// it neither knows its place nor drives to the centimetre.
constexpr double passage = checked_robot_radius + 0.1;
/// Kept free around the middle of a door.
constexpr double door_zone = 0.95;
/// From the middle of a wall to what stands at it.
constexpr double at_wall = 0.12;
constexpr int tries = 12;
/// Side of the cells in which passages are looked for.
constexpr double passage_cell = 0.1;

struct FurnitureKind {
  std::string_view name;
  SolidShape shape;
  double length;
  double width;
  double height;
  bool has_legs;
  bool stands_at_wall;
  std::string_view colour;
};

constexpr std::array<FurnitureKind, 8> furniture_kinds{
  {{"desk", SolidShape::box, 1.4, 0.7, 0.74, false, true, "wood"},
   {"shelf", SolidShape::box, 1.4, 0.35, 1.8, false, true, "white"},
   {"cabinet", SolidShape::box, 0.9, 0.45, 1.2, false, true, "grey"},
   {"sofa", SolidShape::box, 1.8, 0.8, 0.8, false, true, "purple"},
   {"table", SolidShape::box, 1.2, 0.8, 0.74, true, false, "wood"},
   {"stand", SolidShape::disc, 0.8, 0.8, 0.74, false, false, "brown"},
   {"chair", SolidShape::disc, 0.5, 0.5, 0.45, false, false, "blue"},
   {"plant", SolidShape::disc, 0.4, 0.4, 1.3, false, false, "green"}}};

struct ObjectKind {
  std::string_view name;
  double diameter;
  double height;
  std::string_view colour;
};

constexpr std::array<ObjectKind, 5> object_kinds{{{"mug", 0.08, 0.1, "red"},
                                                  {"book", 0.2, 0.05, "green"},
                                                  {"laptop", 0.3, 0.2, "silver"},
                                                  {"bowl", 0.16, 0.08, "yellow"},
                                                  {"ball", 0.2, 0.2, "orange"}}};

double distance(const Rectangle& x, const Point2& p) {
  return std::hypot(std::max({x.low.x - p.x, p.x - x.high.x, 0.0}),
                    std::max({x.low.y - p.y, p.y - x.high.y, 0.0}));
}

/// Half the sides of the box along the axes around a piece of furniture.
Point2 half_sides(const Solid& x) {
  const double c = std::abs(std::cos(x.pose.heading));
  const double s = std::abs(std::sin(x.pose.heading));
  if (x.shape == SolidShape::disc)
    return {x.length / 2, x.length / 2};
  return {(c * x.length + s * x.width) / 2, (s * x.length + c * x.width) / 2};
}

/// One room, with what stands in it.
class RoomPassages {
public:
  RoomPassages(const Rectangle& room, const std::vector<Door>& doors) : room_(room) {
    for (const auto& door : doors)
      if (distance(room, door.opening.from) < 0.05)
        doors_.push_back(door.opening.from);
  }

  const std::vector<Point2>& doors() const { return doors_; }

  /// Whether the robot gets from everywhere where it fits to everywhere else.
  bool all_connected(const std::vector<Furniture>& pieces) const {
    Building only;
    only.furniture = pieces;
    const SolidObstacles obstacles(between_heights(solids_of(only), 0, checked_robot_height));
    const int columns = static_cast<int>(room_.length() / passage_cell);
    const int rows = static_cast<int>(room_.width() / passage_cell);
    std::vector<std::uint8_t> free(static_cast<std::size_t>(columns) *
                                   static_cast<std::size_t>(rows));
    const auto at = [&](int column, int row) -> std::uint8_t& {
      return free[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
    };
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        at(column, row) = is_free(
          {room_.low.x + (column + 0.5) * passage_cell, room_.low.y + (row + 0.5) * passage_cell},
          obstacles);
    std::vector<std::pair<int, int>> waiting;
    const auto take = [&](int column, int row) {
      if (column < 0 || row < 0 || column >= columns || row >= rows)
        return;
      if (std::exchange(at(column, row), std::uint8_t{0}) != 0)
        waiting.emplace_back(column, row);
    };
    const auto first = std::ranges::find(free, 1) - free.begin();
    if (first == std::ssize(free))
      return false;
    take(static_cast<int>(first % columns), static_cast<int>(first / columns));
    while (!waiting.empty()) {
      const auto [column, row] = waiting.back();
      waiting.pop_back();
      take(column + 1, row);
      take(column - 1, row);
      take(column, row + 1);
      take(column, row - 1);
    }
    return std::ranges::count(free, 1) == 0;
  }

private:
  bool is_free(const Point2& p, const SolidObstacles& obstacles) const {
    const double from_walls =
      std::min({p.x - room_.low.x, room_.high.x - p.x, p.y - room_.low.y, room_.high.y - p.y}) -
      at_wall;
    return from_walls >= passage && obstacles.clearance(p, 2 * passage) >= passage;
  }

  Rectangle room_;
  std::vector<Point2> doors_;
};

class Furnishing {
public:
  Furnishing(FloorLayout& floor, const GeneratorOptions& options, SeededUniform& random)
    : floor_(floor), options_(options), random_(random) {
    // nop
  }

  void run() {
    for (const auto& room : floor_.rooms)
      furnish(room);
    for (const auto& part : floor_.corridor)
      furnish_corridor(part);
  }

private:
  std::size_t up_to(int most) { return random_.below(static_cast<std::size_t>(most) + 1); }

  std::string name_of(std::string_view kind) {
    return std::string{kind} + "-" +
           std::to_string(floor_.building.furniture.size() + floor_.building.objects.size() + 1);
  }

  static Furniture piece_of(const FurnitureKind& kind) {
    Furniture x;
    x.kind = kind.name;
    x.has_legs = kind.has_legs;
    x.body.shape = kind.shape;
    x.body.length = kind.length;
    x.body.width = kind.width;
    x.body.top = kind.height;
    x.body.colour = *colour_named(kind.colour);
    return x;
  }

  /// Along one of the walls, somewhere.
  void put_at_wall(Solid& x, const Rectangle& room) {
    const auto side = random_.below(4);
    x.pose.heading = side < 2 ? 0 : std::numbers::pi / 2;
    const auto half = half_sides(x);
    put_within(x, room);
    if (side < 2)
      x.pose.y = side == 0 ? room.low.y + at_wall + half.y : room.high.y - at_wall - half.y;
    else
      x.pose.x = side == 2 ? room.low.x + at_wall + half.x : room.high.x - at_wall - half.x;
  }

  void put_within(Solid& x, const Rectangle& room) {
    const auto half = half_sides(x);
    x.pose.x =
      to_centimetre(random_.between(room.low.x + at_wall + half.x, room.high.x - at_wall - half.x));
    x.pose.y =
      to_centimetre(random_.between(room.low.y + at_wall + half.y, room.high.y - at_wall - half.y));
  }

  static Rectangle around(const Solid& x) {
    const auto half = half_sides(x);
    return {{x.pose.x - half.x, x.pose.y - half.y}, {x.pose.x + half.x, x.pose.y + half.y}};
  }

  static bool overlap(const Solid& a, const Solid& b) {
    const auto x = around(a);
    const auto y = around(b);
    return x.low.x < y.high.x && y.low.x < x.high.x && x.low.y < y.high.y && y.low.y < x.high.y;
  }

  void furnish(const Rectangle& room) {
    const RoomPassages passages(room, floor_.building.doors);
    std::vector<Furniture> pieces;
    const auto count = up_to(options_.furniture);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& kind = furniture_kinds[random_.below(furniture_kinds.size())];
      for (int j = 0; j < tries; ++j) {
        auto piece = piece_of(kind);
        if (kind.stands_at_wall)
          put_at_wall(piece.body, room);
        else
          put_within(piece.body, room);
        const auto place = around(piece.body);
        if (std::ranges::any_of(passages.doors(),
                                [&](auto& p) { return distance(place, p) < door_zone; }) ||
            std::ranges::any_of(pieces, [&](auto& x) { return overlap(x.body, piece.body); }))
          continue;
        pieces.push_back(piece);
        if (passages.all_connected(pieces))
          break;
        pieces.pop_back();
      }
    }
    for (auto& x : pieces) {
      x.name = name_of(x.kind);
      floor_.building.furniture.push_back(x);
    }
    put_objects_on(pieces);
  }

  void put_objects_on(const std::vector<Furniture>& pieces) {
    std::vector<Furniture> tops;
    std::ranges::copy_if(pieces, std::back_inserter(tops),
                         [](auto& x) { return x.kind == "desk" || x.kind == "table"; });
    auto count = tops.empty() ? 0 : up_to(options_.objects);
    for (; count > 0; --count) {
      const auto& top = tops[random_.below(tops.size())].body;
      const auto& kind = object_kinds[random_.below(object_kinds.size())];
      BuildingObject x;
      x.kind = kind.name;
      x.name = name_of(kind.name);
      x.body.shape = SolidShape::disc;
      const auto at = compose(top.pose, {random_.between(-0.35, 0.35) * top.length,
                                         random_.between(-0.3, 0.3) * top.width, 0});
      x.body.pose = {to_centimetre(at.x), to_centimetre(at.y), 0};
      x.body.length = x.body.width = kind.diameter;
      x.body.bottom = top.top;
      x.body.top = top.top + kind.height;
      x.body.colour = *colour_named(kind.colour);
      floor_.building.objects.push_back(std::move(x));
    }
  }

  /// At most one narrow piece at a long wall, away from doors and from other parts of the corridor.
  void furnish_corridor(const Rectangle& part) {
    const double width = std::min(part.length(), part.width());
    const bool along_x = part.length() > part.width();
    if (width < 1.6 || options_.furniture == 0)
      return;
    for (int j = 0; j < tries; ++j) {
      auto piece = piece_of(furniture_kinds[1]);
      piece.body.length = 1;
      put_at_wall(piece.body, part);
      const auto place = around(piece.body);
      const bool is_along = (piece.body.pose.heading == 0) == along_x;
      const bool is_near_door = std::ranges::any_of(floor_.building.doors, [&](auto& x) {
        return distance(place, x.opening.from) < door_zone;
      });
      const bool is_near_corner = std::ranges::any_of(
        floor_.corridor, [&](auto& x) { return &x != &part && gap(place, x) < door_zone; });
      if (!is_along || is_near_door || is_near_corner)
        continue;
      piece.name = name_of(piece.kind);
      floor_.building.furniture.push_back(std::move(piece));
      return;
    }
  }

  static double gap(const Rectangle& a, const Rectangle& b) {
    return std::hypot(std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0}),
                      std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0}));
  }

  FloorLayout& floor_;
  const GeneratorOptions& options_;
  SeededUniform& random_;
};

} // namespace

void furnish_floor(FloorLayout& floor, const GeneratorOptions& options, SeededUniform& random) {
  Furnishing(floor, options, random).run();
}

} // namespace castor::mapping
