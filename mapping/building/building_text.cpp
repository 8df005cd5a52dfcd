#include "castor/mapping/building/building_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace castor::mapping {

namespace {

/// As short as it can be, without "-0".
std::string number(double x, double step) {
  return fmt::format("{:.10g}", std::round(x / step) * step + 0.0);
}

std::string metres(double x) {
  return number(x, 1e-4);
}

std::string degrees(double radians) {
  return number(radians * 180 / std::numbers::pi, 1e-3);
}

std::string point(const Point2& p) {
  return metres(p.x) + " " + metres(p.y);
}

std::string colour_text(const Colour& x) {
  for (const auto& name : colour_names())
    if (colour_named(name) == x)
      return name;
  return fmt::format("#{:02x}{:02x}{:02x}", x.red, x.green, x.blue);
}

std::string furniture_text(const Furniture& x) {
  const auto& body = x.body;
  auto result = fmt::format("furniture {} at {}", x.kind, point({body.pose.x, body.pose.y}));
  const auto height = metres(body.top - body.bottom);
  if (body.shape == SolidShape::disc)
    result += fmt::format(" disc {} {}", metres(body.length), height);
  else
    result += fmt::format(" box {} {} {}", metres(body.length), metres(body.width), height);
  if (body.bottom > 0)
    result += " on " + metres(body.bottom);
  if (body.pose.heading != 0)
    result += " turned " + degrees(body.pose.heading);
  result += " colour " + colour_text(body.colour);
  if (x.has_legs)
    result += " legs";
  if (!x.name.empty())
    result += " name=" + x.name;
  return result + '\n';
}

std::string object_text(const BuildingObject& x) {
  const auto& body = x.body;
  auto result = fmt::format("object {} at {} size {} {}", x.kind, point({body.pose.x, body.pose.y}),
                            metres(body.length), metres(body.top - body.bottom));
  if (body.bottom > 0)
    result += " on " + metres(body.bottom);
  result += " colour " + colour_text(body.colour);
  if (!x.name.empty())
    result += " name=" + x.name;
  return result + '\n';
}

} // namespace

std::string building_text(const Building& x) {
  std::string result;
  if (!x.name.empty())
    result += "building " + x.name + '\n';
  result += "height " + metres(x.height) + "\n\n";
  for (const auto& wall : x.walls)
    result += fmt::format("wall {} to {} thickness {}\n", point(wall.middle.from),
                          point(wall.middle.to), metres(wall.thickness));
  result += '\n';
  for (const auto& room : x.rooms)
    result += fmt::format("room {} at {} kind {}\n", room.name, point(room.inside), room.kind);
  result += '\n';
  for (const auto& door : x.doors)
    result +=
      fmt::format("door {} at {} width {}{}\n", door.name, point(point_at(door.opening, 0.5)),
                  metres(door.width), door.is_open ? "" : " shut");
  result += '\n';
  for (const auto& thing : x.furniture)
    result += furniture_text(thing);
  for (const auto& object : x.objects)
    result += object_text(object);
  result += '\n';
  for (const auto& person : x.people) {
    result += fmt::format("person {} route {}", person.name, point(person.route.front()));
    for (std::size_t i = 1; i < person.route.size(); ++i)
      result += " to " + point(person.route[i]);
    result +=
      fmt::format("{} speed {}", person.is_loop ? " loop" : "", number(person.speed, 1e-4));
    if (person.pause > 0)
      result += " pause " + number(person.pause, 1e-4);
    result += '\n';
  }
  return result + fmt::format("start {} heading {}\n", point({x.start.x, x.start.y}),
                              degrees(x.start.heading));
}

} // namespace castor::mapping
