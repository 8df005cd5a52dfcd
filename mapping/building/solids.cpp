#include "castor/mapping/building/solids.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

namespace {

constexpr Colour wall_colour{225, 220, 205};
constexpr Colour door_colour{150, 95, 55};
constexpr double door_leaf = 0.04;    // metres
constexpr double leg_diameter = 0.05; // metres
constexpr double tabletop = 0.04;     // metres

Solid upright_box(const Segment& middle, double thickness, double bottom, double top,
                  const Colour& colour) {
  const auto centre = point_at(middle, 0.5);
  return {
    SolidShape::box,
    {centre.x, centre.y, std::atan2(middle.to.y - middle.from.y, middle.to.x - middle.from.x)},
    length(middle),
    thickness,
    bottom,
    top,
    colour};
}

/// The wall's pieces beside its doors. Its ends are longer by half of its thickness, so that
/// corners are filled.
void add_wall(const Building& x, std::size_t index, std::vector<Solid>& out) {
  const auto& wall = x.walls[index];
  const double whole = length(wall.middle);
  if (!(whole > 0))
    return;
  const double beyond = wall.thickness / 2;
  std::vector<const Door*> doors;
  for (const auto& door : x.doors)
    if (door.wall == index && length(door.opening) > 0)
      doors.push_back(&door);
  auto along = [&](const Point2& p) { return nearest_share(wall.middle, p) * whole; };
  auto start_of = [&](const Door* door) {
    return std::min(along(door->opening.from), along(door->opening.to));
  };
  std::ranges::sort(doors, {}, start_of);
  double at = -beyond;
  auto piece = [&](double from, double to, double bottom) {
    constexpr double shortest = 1e-6;
    if (to - from > shortest)
      out.push_back(
        upright_box({point_at(wall.middle, from / whole), point_at(wall.middle, to / whole)},
                    wall.thickness, bottom, x.height, wall_colour));
  };
  for (const auto* door : doors) {
    const double from = start_of(door);
    const double to = from + length(door->opening);
    piece(at, from, 0);
    if (x.height > door_height)
      piece(from, to, door_height);
    if (!door->is_open)
      out.push_back(upright_box(door->opening, std::min(door_leaf, wall.thickness), 0,
                                std::min(door_height, x.height), door_colour));
    at = to;
  }
  piece(at, whole + beyond, 0);
}

void add_furniture(const Furniture& x, std::vector<Solid>& out) {
  if (!x.has_legs) {
    out.push_back(x.body);
    return;
  }
  auto top = x.body;
  top.bottom = std::max(x.body.bottom, x.body.top - tabletop);
  out.push_back(top);
  auto leg = x.body;
  leg.shape = SolidShape::disc;
  leg.length = leg.width = leg_diameter;
  leg.top = top.bottom;
  // A round table stands on legs within its circle.
  const double inset = x.body.shape == SolidShape::disc ? std::sqrt(0.5) : 1;
  const double across = std::max(0.0, x.body.length * inset / 2 - leg_diameter);
  const double aside = std::max(0.0, x.body.width * inset / 2 - leg_diameter);
  for (double a : {-across, across})
    for (double b : {-aside, aside}) {
      const auto place = transform(x.body.pose, Point2{a, b});
      leg.pose = {place.x, place.y, 0};
      out.push_back(leg);
    }
}

} // namespace

std::vector<Solid> solids_of(const Building& x) {
  std::vector<Solid> result;
  for (std::size_t i = 0; i < x.walls.size(); ++i)
    add_wall(x, i, result);
  for (const auto& thing : x.furniture)
    add_furniture(thing, result);
  for (const auto& object : x.objects)
    result.push_back(object.body);
  return result;
}

std::vector<Solid> between_heights(const std::vector<Solid>& solids, double low, double high) {
  std::vector<Solid> result;
  std::ranges::copy_if(solids, std::back_inserter(result),
                       [&](const Solid& x) { return x.bottom <= high && x.top >= low; });
  return result;
}

} // namespace castor::mapping
