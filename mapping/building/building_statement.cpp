#include "castor/mapping/building/building_statement.hpp"

#include "castor/base/text_file.hpp"

#include <numbers>
#include <span>

namespace castor::mapping {

namespace {

// What is taken for a slip of the pen beyond these, metres.
constexpr double farthest = 1000;
constexpr double smallest_thing = 0.01;
constexpr double largest_furniture = 20;
constexpr double largest_object = 3;
constexpr double highest = 20;

constexpr std::string_view name_clause = "name=";

Point2 read_point(StatementWords& words, const std::string& of_what) {
  const double x = words.length("the x of " + of_what, -farthest, farthest);
  const double y = words.length("the y of " + of_what, -farthest, farthest);
  return {x, y};
}

Point2 read_place(StatementWords& words, const std::string& of_what) {
  if (!words.accept("at"))
    throw StatementError("there is no place of " + of_what,
                         "Write \"at\" and two numbers, for example: at 2.5 3");
  return read_point(words, of_what);
}

double read_radians(StatementWords& words, const std::string& what) {
  return normalised(words.number(what, -360, 360) * std::numbers::pi / 180);
}

Colour read_colour(StatementWords& words) {
  const std::string word = words.next("a colour");
  if (auto colour = colour_named(word))
    return *colour;
  throw StatementError("\"" + word + "\" is not a colour that is known here",
                       remedy_for(word, colour_names(), "colours") +
                         " Any other can be written as #rrggbb, for example #ff8000.");
}

std::string read_name_clause(StatementWords& words) {
  const std::string word = words.next("a name");
  std::string name = word.substr(name_clause.size());
  if (!is_statement_name(name))
    throw StatementError("\"" + name + "\" is no name",
                         "A name is one word of at most 64 letters, digits, - and _.");
  return name;
}

[[noreturn]] void refuse_clause(const StatementWords& words, const std::string& of_what,
                                const std::vector<std::string>& clauses) {
  throw StatementError("\"" + words.peek() + "\" is no property of " + of_what,
                       remedy_for(words.peek(), clauses, "possibilities"));
}

/// X Y to X Y [to X Y ...]
std::vector<Point2> read_points(StatementWords& words, const std::string& of_what) {
  std::vector<Point2> result{read_point(words, of_what)};
  while (words.accept("to")) {
    auto next = read_point(words, of_what);
    if (next == result.back())
      throw StatementError("two points in a row of " + of_what + " are the same",
                           "Leave one of them out.");
    result.push_back(next);
  }
  if (result.size() < 2)
    throw StatementError("there is only one point of " + of_what,
                         "Write \"to\" and two numbers after it, for example: to 4 0");
  return result;
}

void read_box(StatementWords& words, Solid& body) {
  body.shape = SolidShape::box;
  body.length = words.length("the length", smallest_thing, largest_furniture);
  body.width = words.length("the width", smallest_thing, largest_furniture);
  body.top = words.length("the height", smallest_thing, highest);
}

void read_disc(StatementWords& words, Solid& body, double largest) {
  body.shape = SolidShape::disc;
  body.length = body.width = words.length("the diameter", smallest_thing, largest);
  body.top = words.length("the height", smallest_thing, highest);
}

void raise(Solid& body, double z) {
  body.bottom += z;
  body.top += z;
}

} // namespace

const std::vector<std::string>& building_keywords() {
  static const std::vector<std::string> keywords{"building", "height", "thickness", "wall",
                                                 "door",     "room",   "furniture", "object",
                                                 "person",   "start"};
  return keywords;
}

std::vector<Wall> read_walls(StatementWords& words, double thickness) {
  auto points = read_points(words, "the wall");
  while (!words.at_end()) {
    if (words.accept("close")) {
      if (points.size() < 3)
        throw StatementError("a wall of two points cannot be closed",
                             "Add points, or remove \"close\".");
      // It may be closed already.
      if (points.back() != points.front())
        points.push_back(points.front());
    } else if (words.accept("thickness")) {
      thickness = words.length("the thickness", 0.01, 2);
    } else {
      refuse_clause(words, "a wall", {"to", "close", "thickness"});
    }
  }
  std::vector<Wall> result;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    result.push_back({{points[i], points[i + 1]}, thickness});
  return result;
}

Door read_door(StatementWords& words) {
  Door door;
  door.name = words.name("the door's name");
  const auto place = read_place(words, "the door");
  door.opening = {place, place};
  while (!words.at_end()) {
    if (words.accept("width"))
      door.width = words.length("the door's width", 0.3, 10);
    else if (words.accept("open"))
      door.is_open = true;
    else if (words.accept("shut"))
      door.is_open = false;
    else
      refuse_clause(words, "a door", {"width", "open", "shut"});
  }
  return door;
}

Room read_room(StatementWords& words) {
  Room room;
  room.name = words.name("the room's name");
  room.inside = read_place(words, "the room");
  room.kind = room.name;
  while (!words.at_end()) {
    if (words.accept("kind"))
      room.kind = words.name("the kind of room");
    else
      refuse_clause(words, "a room", {"kind"});
  }
  return room;
}

Furniture read_furniture(StatementWords& words) {
  Furniture thing;
  thing.kind = words.name("the kind of furniture");
  const auto place = read_place(words, "the " + thing.kind);
  thing.body.pose = {place.x, place.y, 0};
  thing.body.colour = *colour_named("wood");
  if (words.accept("box"))
    read_box(words, thing.body);
  else if (words.accept("disc"))
    read_disc(words, thing.body, largest_furniture);
  else
    throw StatementError("there is no shape of the " + thing.kind,
                         "Write for example: box 1.6 0.8 0.75 (length, width, height), or: disc "
                         "0.9 0.72 (diameter, height)");
  while (!words.at_end()) {
    if (words.accept("on"))
      raise(thing.body, words.length("the height that it is on", 0, highest));
    else if (words.accept("turned"))
      thing.body.pose.heading = read_radians(words, "the turn in degrees");
    else if (words.accept("colour") || words.accept("color"))
      thing.body.colour = read_colour(words);
    else if (words.accept("legs"))
      thing.has_legs = true;
    else if (words.peek().starts_with(name_clause))
      thing.name = read_name_clause(words);
    else
      refuse_clause(words, "furniture", {"on", "turned", "colour", "legs", "name=..."});
  }
  return thing;
}

BuildingObject read_building_object(StatementWords& words) {
  BuildingObject object;
  object.kind = words.name("the kind of object");
  const auto place = read_place(words, "the " + object.kind);
  object.body.shape = SolidShape::disc;
  object.body.pose = {place.x, place.y, 0};
  object.body.length = object.body.width = 0.1;
  object.body.top = 0.12;
  object.body.colour = *colour_named("grey");
  while (!words.at_end()) {
    if (words.accept("size")) {
      const double z = object.body.bottom;
      read_disc(words, object.body, largest_object);
      object.body.top += z;
    } else if (words.accept("on")) {
      raise(object.body, words.length("the height that it is on", 0, highest));
    } else if (words.accept("colour") || words.accept("color")) {
      object.body.colour = read_colour(words);
    } else if (words.peek().starts_with(name_clause)) {
      object.name = read_name_clause(words);
    } else {
      refuse_clause(words, "an object", {"size", "on", "colour", "name=..."});
    }
  }
  return object;
}

Walker read_walker(StatementWords& words) {
  Walker person;
  person.name = words.name("the person's name");
  if (!words.accept("route"))
    throw StatementError("there is no route of " + person.name,
                         "Write for example: route 1 1 to 5 1 to 5 4");
  person.route = read_points(words, "the route");
  while (!words.at_end()) {
    if (words.accept("loop"))
      person.is_loop = true;
    else if (words.accept("speed"))
      person.speed = words.number("the speed in m/s", 0.01, 5);
    else if (words.accept("pause"))
      person.pause = words.number("the pause in seconds", 0, 3600);
    else
      refuse_clause(words, "a person", {"to", "loop", "speed", "pause"});
  }
  return person;
}

Pose2 read_start(StatementWords& words) {
  const auto place = read_point(words, "the start");
  Pose2 start{place.x, place.y, 0};
  if (words.accept("heading"))
    start.heading = read_radians(words, "the heading in degrees");
  return start;
}

} // namespace castor::mapping
