#include "castor/perception/vision/tabletop/tabletop_scene_statement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "castor/base/suggestion.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_names.hpp"

namespace castor::vision {

namespace {

// What is taken for a slip of the pen beyond these.
constexpr double room = 10;               // metres
constexpr double smallest_object = 0.005; // metres
constexpr double largest_object = 0.5;    // metres
constexpr double longest_time = 86'400;   // seconds

const std::array<std::string, 6> scene_settings{"table", "camera", "image",
                                                "light", "noise",  "seed"};
const std::array<std::string, 3> object_clauses{"size", "turned", "name=..."};
const std::array<std::string, 3> materials{"wood", "cloth", "plain"};

SceneTime read_scene_time(StatementWords& words, const std::string& what) {
  return SceneTime{std::llround(words.seconds(what, longest_time) * 1e6)};
}

std::string read_colour_name(StatementWords& words) {
  std::string word = words.next("a colour");
  if (colour_named(word))
    return word;
  std::vector<std::string> names = colour_names();
  if (word.starts_with('#'))
    throw StatementError("\"" + word + "\" is not a colour",
                         "Write # and six hexadecimal digits, for example #ff8000.");
  if (shape_named(words.peek()))
    throw StatementError("\"" + word + "\" is not a colour that is known here",
                         remedy_for(word, names, "colours") +
                           " Any other can be written as #rrggbb, for example #ff8000.");
  names.insert(names.end(), scene_settings.begin(), scene_settings.end());
  names.emplace_back("after");
  const auto guess = did_you_mean(word, {names.begin(), names.end()});
  throw StatementError("\"" + word + "\" is not the beginning of a statement",
                       !guess.empty() ? guess
                                      : "A line begins with " + joined(scene_settings) +
                                          ", after, or with the colour of an object.");
}

TabletopShape read_shape(StatementWords& words) {
  const std::string word = words.next("a shape");
  const auto shape = shape_named(word);
  if (!shape)
    throw StatementError("\"" + word + "\" is not a shape that is known here",
                         remedy_for(word, shape_names(), "shapes"));
  return *shape;
}

ObjectReference read_reference(StatementWords& words) {
  ObjectReference reference;
  if (!colour_named(words.peek())) {
    reference.name = words.next("an object");
    if (shape_named(words.peek()))
      throw StatementError("\"" + reference.name + "\" is not a colour that is known here",
                           remedy_for(reference.name, colour_names(), "colours"));
    return reference;
  }
  reference.colour_name = read_colour_name(words);
  reference.shape = read_shape(words);
  return reference;
}

std::vector<double> read_sizes(StatementWords& words, TabletopShape shape) {
  std::vector<double> sizes;
  const auto count = size_count(shape);
  do {
    if (sizes.size() == count)
      throw StatementError("a " + std::string(to_string(shape)) + " has " + std::to_string(count) +
                             (count == 1 ? " size" : " sizes"),
                           "Remove \"" + words.peek() + "\" and what follows it.");
    const auto value = parse_length(words.peek());
    if (value && *value > largest_object)
      throw StatementError("a size of " + readable(*value) + " metres is too large for the table",
                           "Sizes are metres up to " + readable(largest_object) +
                             ": six centimetres are 0.06 or 6cm.");
    sizes.push_back(words.length("a size", smallest_object, largest_object));
    words.accept("x");
  } while (parse_length(words.peek()));
  return sizes;
}

} // namespace

std::string ObjectReference::text() const {
  return shape ? colour_name + " " + std::string(to_string(*shape)) : name;
}

bool is_scene_setting(const std::string& word) {
  return std::find(scene_settings.begin(), scene_settings.end(), word) != scene_settings.end();
}

TableLook read_table(StatementWords& words) {
  TableLook table;
  std::optional<SceneColour> colour;
  std::optional<TableLook::Material> material;
  if (words.at_end())
    throw StatementError("the material or colour of the table is missing",
                         "Write for example: table wood, table cloth, table grey");
  while (!words.at_end()) {
    if (words.accept("size")) {
      table.width = words.length("the table's width", 0.1, room);
      words.accept("x");
      table.depth = words.length("the table's depth", 0.1, room);
      continue;
    }
    const std::string word = words.next("a look");
    if (const auto named = colour_named(word); named && !colour) {
      colour = named;
    } else if (const auto which = std::find(materials.begin(), materials.end(), word);
               which != materials.end() && !material) {
      material = static_cast<TableLook::Material>(which - materials.begin());
    } else {
      std::vector<std::string> looks(materials.begin(), materials.end());
      looks.insert(looks.end(), colour_names().begin(), colour_names().end());
      looks.emplace_back("size");
      throw StatementError("\"" + word +
                             "\" is not a material or colour of a table, or is one too many",
                           remedy_for(word, looks, "looks"));
    }
  }
  constexpr SceneColour cloth_colour{92, 104, 112};
  constexpr SceneColour plain_colour{150, 150, 146};
  // A colour on its own is paint.
  table.material =
    material.value_or(colour ? TableLook::Material::plain : TableLook::Material::wood);
  if (colour)
    table.colour = *colour;
  else if (table.material == TableLook::Material::cloth)
    table.colour = cloth_colour;
  else if (table.material == TableLook::Material::plain)
    table.colour = plain_colour;
  return table;
}

CameraPlace read_camera_place(StatementWords& words) {
  CameraPlace place;
  place.eye.x = words.length("the camera's x", -room, room);
  place.eye.y = words.length("the camera's y", -room, room);
  place.eye.z = words.length("the camera's z", -room, room);
  if (!(place.eye.z >= 0.05))
    throw StatementError("the camera is not above the table",
                         "Let its third number, the height, be 0.05 (metres) or more.");
  while (!words.at_end()) {
    if (words.accept("looking-at")) {
      place.target.x = words.length("the x that the camera looks at", -room, room);
      place.target.y = words.length("the y that the camera looks at", -room, room);
      place.target.z = words.length("the z that the camera looks at", -room, room);
    } else if (words.accept("fov")) {
      place.fov_degrees = words.number("the field of view", 5, 150);
    } else {
      const std::array<std::string, 2> clauses{"looking-at", "fov"};
      throw StatementError("\"" + words.peek() + "\" is not a property of a camera",
                           remedy_for(words.peek(), clauses, "possibilities"));
    }
  }
  if (!((to_eigen(place.target) - to_eigen(place.eye)).norm() > 0.01))
    throw StatementError("the camera and the point that it looks at are the same",
                         "Let it look at the middle of the table: looking-at 0 0 0");
  return place;
}

ImageSize read_image_size(StatementWords& words) {
  const auto side = [&](const std::string& what) {
    const double pixels = words.number(what, 16, 4096);
    if (pixels != std::floor(pixels))
      throw StatementError(what + " is no whole number", "Write for example: image 640 480");
    return static_cast<int>(pixels);
  };
  ImageSize size;
  size.width = side("the image's width");
  words.accept("x");
  size.height = side("the image's height");
  return size;
}

Point3 read_light(StatementWords& words) {
  Point3 light;
  light.x = words.length("the lamp's x", -room, room);
  light.y = words.length("the lamp's y", -room, room);
  light.z = words.length("the lamp's z", -room, room);
  if (!(light.z >= 0.5))
    throw StatementError("the lamp is not well above the table",
                         "Let its third number, the height, be 0.5 (metres) or more.");
  return light;
}

double read_noise(StatementWords& words) {
  return words.number("the noise", 0, 64);
}

std::uint64_t read_seed(StatementWords& words) {
  constexpr double highest = 1e15;
  const double seed = words.number("the seed", 0, highest);
  if (seed != std::floor(seed))
    throw StatementError("the seed is no whole number", "Write for example: seed 7");
  return static_cast<std::uint64_t>(seed);
}

TabletopObject read_object(StatementWords& words) {
  TabletopObject object;
  object.colour_name = read_colour_name(words);
  object.colour = *colour_named(object.colour_name);
  object.shape = read_shape(words);
  object.size = size_of(object.shape, {});
  if (!words.accept("at"))
    throw StatementError("there is no position of the " + object.colour_name + " " +
                           std::string(to_string(object.shape)),
                         "Write \"at\" and two numbers after the shape, for example: at 0.1 0.05");
  object.x = words.length("the object's x", -room, room);
  object.y = words.length("the object's y", -room, room);
  constexpr std::string_view name_clause = "name=";
  while (!words.at_end()) {
    if (words.accept("size")) {
      object.size = size_of(object.shape, read_sizes(words, object.shape));
    } else if (words.accept("turned")) {
      object.turned_degrees = words.number("the turn in degrees", -360, 360);
    } else if (words.peek().starts_with(name_clause)) {
      object.name = words.next("a name").substr(name_clause.size());
      if (!is_statement_name(object.name) || colour_named(object.name))
        throw StatementError("\"" + object.name + "\" is no name for an object",
                             "A name is one word of letters, digits, - and _ that is no colour.");
    } else {
      throw StatementError("\"" + words.peek() + "\" is not a property of an object",
                           remedy_for(words.peek(), object_clauses, "possibilities"));
    }
  }
  return object;
}

SceneTime read_time(StatementWords& words) {
  words.accept("after");
  return read_scene_time(words, "the time");
}

SceneEvent read_event(StatementWords& words) {
  if (words.accept("add"))
    return AddEvent{read_object(words)};
  if (words.accept("remove"))
    return RemoveEvent{read_reference(words)};
  if (!words.accept("move")) {
    const std::array<std::string, 3> verbs{"add", "move", "remove"};
    const std::string word = words.next("add, move or remove");
    throw StatementError("\"" + word + "\" is not an event",
                         remedy_for(word, verbs, "possibilities"));
  }
  MoveEvent move{read_reference(words)};
  if (!words.accept("to"))
    throw StatementError("there is no position to move the object to",
                         "Write \"to\" and two numbers, for example: to 0.1 0.05");
  move.x = words.length("the x to move to", -room, room);
  move.y = words.length("the y to move to", -room, room);
  if (words.accept("over"))
    move.duration = read_scene_time(words, "the time that it takes");
  return move;
}

} // namespace castor::vision
