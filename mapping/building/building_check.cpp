#include "castor/mapping/building/building_check.hpp"

#include "castor/base/statement_words.hpp"
#include "castor/mapping/building/enclosed_regions.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace castor::mapping {

namespace {

/// How far beside the middle of a wall a door may be given, beyond the wall's surface; metres.
constexpr double slack = 0.05;

std::string place(const Point2& p) {
  // To the millimetre.
  auto rounded = [](double x) { return readable(std::round(x * 1000) / 1000 + 0.0); };
  return rounded(p.x) + " " + rounded(p.y);
}

class BuildingCheck {
public:
  explicit BuildingCheck(Building& x) : x_(x) {
    // nop
  }

  std::vector<BuildingRemark> run() {
    check_names();
    for (auto& door : x_.doors)
      put_into_wall(door);
    check_door_neighbours();
    find_rooms();
    check_start();
    check_inside();
    check_people();
    return std::move(remarks_);
  }

private:
  void error(int line, std::string message, std::string remedy) {
    remarks_.push_back({true, line, std::move(message), std::move(remedy)});
  }

  void warning(int line, std::string message, std::string remedy) {
    remarks_.push_back({false, line, std::move(message), std::move(remedy)});
  }

  template <class Things>
  void check_names_of(const Things& things, std::map<std::string, int>& lines) {
    for (const auto& thing : things)
      if (auto [first, is_new] = lines.emplace(thing.name, thing.line); !is_new)
        error(thing.line, "the name \"" + thing.name + "\" is given twice",
              "Give it another name here, or in line " + std::to_string(first->second) + ".");
  }

  void check_names() {
    std::map<std::string, int> lines;
    check_names_of(x_.doors, lines);
    check_names_of(x_.rooms, lines);
    check_names_of(x_.furniture, lines);
    check_names_of(x_.objects, lines);
    check_names_of(x_.people, lines);
  }

  void put_into_wall(Door& door) {
    const auto at = door.opening.from;
    std::optional<std::size_t> nearest;
    double nearest_distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < x_.walls.size(); ++i)
      if (const double d = distance(x_.walls[i].middle, at); d < nearest_distance) {
        nearest = i;
        nearest_distance = d;
      }
    if (!nearest) {
      error(door.line, "door " + door.name + " is in no wall: there are none",
            "Add walls: wall 0 0 to 5 0 to 5 4 to 0 4 close");
      return;
    }
    const auto& wall = x_.walls[*nearest];
    const double share = nearest_share(wall.middle, at);
    if (nearest_distance > wall.thickness / 2 + slack) {
      error(door.line,
            "door " + door.name + " is in no wall: the nearest one, of line " +
              std::to_string(wall.line) + ", is " +
              readable(std::round(nearest_distance * 1000) / 1000) + " m away",
            "Its middle has to be on a wall, for example: at " +
              place(point_at(wall.middle, share)));
      return;
    }
    const double whole = length(wall.middle);
    const double middle = share * whole;
    constexpr double rounding = 1e-9;
    if (middle - door.width / 2 < -rounding || middle + door.width / 2 > whole + rounding) {
      error(door.line,
            "door " + door.name + " reaches beyond the end of its wall, of line " +
              std::to_string(wall.line),
            door.width > whole
              ? "The wall is " + readable(whole) + " m long: make the door narrower."
              : "Move it by " +
                  readable(
                    std::round(std::max(door.width / 2 - middle, middle + door.width / 2 - whole) *
                               1000) /
                    1000) +
                  " m along the wall, or make it narrower.");
      return;
    }
    door.wall = *nearest;
    door.opening = {point_at(wall.middle, std::max(0.0, (middle - door.width / 2) / whole)),
                    point_at(wall.middle, std::min(1.0, (middle + door.width / 2) / whole))};
  }

  void check_door_neighbours() {
    for (std::size_t i = 0; i < x_.doors.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto& a = x_.doors[i];
        const auto& b = x_.doors[j];
        const double between = distance(point_at(a.opening, 0.5), point_at(b.opening, 0.5));
        if (a.wall == b.wall && length(a.opening) > 0 && length(b.opening) > 0 &&
            between < (length(a.opening) + length(b.opening)) / 2 - 1e-9)
          error(a.line, "doors " + b.name + " and " + a.name + " overlap",
                "Move one of them along the wall; the other is in line " + std::to_string(b.line) +
                  ".");
      }
  }

  std::string remedy_for_open_wall(const EnclosedRegions& found, const Room& room) const {
    if (found.free_ends.empty())
      return "Draw walls all around it; doors are put into walls, and leave no gap in them.";
    const auto& end = *std::ranges::min_element(
      found.free_ends, {}, [&](const Point2& p) { return distance(p, room.inside); });
    return "Walls are joined where one ends at another; the nearest end that is not joined is at " +
           place(end) + ".";
  }

  void find_rooms() {
    std::vector<Segment> walls;
    for (const auto& wall : x_.walls)
      walls.push_back(wall.middle);
    const auto found = enclosed_regions(walls);
    std::map<std::size_t, const Room*> owners;
    for (auto& room : x_.rooms) {
      auto region = region_at(found, room.inside);
      if (!region) {
        error(room.line, "room " + room.name + " is not closed: there is an open wall",
              remedy_for_open_wall(found, room));
        continue;
      }
      if (auto [owner, is_new] = owners.emplace(*region, &room); !is_new) {
        error(room.line,
              "no wall is between room " + room.name + " and room " + owner->second->name +
                ", of line " + std::to_string(owner->second->line),
              "Leave one of them out, or close the wall between them. " +
                remedy_for_open_wall(found, room));
        continue;
      }
      room.outline = found.regions[*region].outline;
      room.holes = found.regions[*region].holes;
      room.area = found.regions[*region].area;
    }
  }

  void check_start() {
    const Point2 start{x_.start.x, x_.start.y};
    const SolidObstacles obstacles(between_heights(solids_of(x_), 0, checked_robot_height));
    const double room = obstacles.clearance(start, 2 * checked_robot_radius);
    if (room <= 0)
      error(x_.start_line, "the start is in a wall, a shut door or furniture",
            "Move it into the free part of a room.");
    else if (room < checked_robot_radius)
      error(x_.start_line,
            "the start is " + readable(std::round(room * 1000) / 1000) +
              " m from the nearest obstacle, and a robot has a radius of " +
              readable(checked_robot_radius) + " m",
            "Move it into the free part of a room.");
    if (!x_.rooms.empty() && !room_at(x_, start))
      warning(x_.start_line, "the start is in none of the rooms",
              "Move it, or add the room that it is in.");
  }

  template <class Things>
  void check_inside_of(const Things& things) {
    for (const auto& thing : things)
      if (!room_at(x_, {thing.body.pose.x, thing.body.pose.y}))
        warning(thing.line, thing.name + " is in none of the rooms",
                "Move it, or add the room that it is in.");
  }

  void check_inside() {
    // While rooms are not closed, nothing can be said of what is in them.
    const bool all_known =
      std::ranges::none_of(x_.rooms, [](const Room& room) { return room.outline.empty(); });
    if (x_.rooms.empty() || !all_known)
      return;
    check_inside_of(x_.furniture);
    check_inside_of(x_.objects);
  }

  void check_people() {
    auto open = x_;
    for (auto& door : open.doors)
      door.is_open = true;
    const SolidObstacles obstacles(between_heights(solids_of(open), 0, checked_robot_height));
    for (const auto& person : x_.people) {
      const std::size_t parts = person.route.size() - (person.is_loop ? 0 : 1);
      for (std::size_t i = 0; i < parts; ++i) {
        const auto& from = person.route[i];
        const auto& to = person.route[(i + 1) % person.route.size()];
        const double way = distance(from, to);
        const auto hit = obstacles.cast(from, std::atan2(to.y - from.y, to.x - from.x), way);
        if (hit) {
          warning(person.line,
                  person.name + " walks through an obstacle at " +
                    place(point_at({from, to}, way > 0 ? *hit / way : 0)),
                  "Lead the route around it, or through a door.");
          break;
        }
      }
    }
  }

  Building& x_;
  std::vector<BuildingRemark> remarks_;
};

} // namespace

std::vector<BuildingRemark> complete_building(Building& x) {
  return BuildingCheck(x).run();
}

} // namespace castor::mapping
