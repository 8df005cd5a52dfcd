#include "castor/perception/vision/tabletop/tabletop_scene_names.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <numbers>

namespace castor::vision {

namespace {

struct NamedColour {
  std::string_view name;
  SceneColour colour;
};

/// The colours of painted wooden toys rather than those of a screen.
constexpr NamedColour colours[] = {
  {"red", {200, 32, 34}},     {"green", {34, 140, 58}},   {"blue", {32, 72, 184}},
  {"yellow", {240, 200, 24}}, {"orange", {236, 116, 20}}, {"purple", {112, 48, 150}},
  {"pink", {232, 112, 160}},  {"brown", {104, 60, 32}},   {"black", {28, 28, 30}},
  {"white", {236, 236, 232}}, {"grey", {128, 128, 128}},  {"gray", {128, 128, 128}},
  {"cyan", {30, 170, 190}},   {"magenta", {190, 30, 140}}};

struct NamedShape {
  std::string_view name;
  TabletopShape shape;
};

constexpr NamedShape shapes[] = {{"cube", TabletopShape::cube},
                                 {"block", TabletopShape::cube},
                                 {"box", TabletopShape::box},
                                 {"brick", TabletopShape::box},
                                 {"cylinder", TabletopShape::cylinder},
                                 {"can", TabletopShape::cylinder},
                                 {"sphere", TabletopShape::sphere},
                                 {"ball", TabletopShape::sphere},
                                 {"square", TabletopShape::square},
                                 {"plate", TabletopShape::square},
                                 {"rectangle", TabletopShape::rectangle},
                                 {"triangle", TabletopShape::triangle},
                                 {"disc", TabletopShape::disc},
                                 {"disk", TabletopShape::disc},
                                 {"circle", TabletopShape::disc}};

constexpr double flat_thickness = 0.005;
constexpr double solid_default = 0.06;
constexpr double flat_default = 0.08;
constexpr double long_default = 0.10;

} // namespace

std::optional<SceneColour> colour_named(std::string_view word) {
  const auto found =
    std::find_if(std::begin(colours), std::end(colours),
                 [&](const NamedColour& candidate) { return candidate.name == word; });
  if (found != std::end(colours))
    return found->colour;
  if (word.size() != 7 || word[0] != '#')
    return std::nullopt;
  unsigned value = 0;
  const auto [end, error] = std::from_chars(word.data() + 1, word.data() + 7, value, 16);
  if (error != std::errc{} || end != word.data() + 7)
    return std::nullopt;
  return SceneColour{static_cast<std::uint8_t>(value >> 16),
                     static_cast<std::uint8_t>(value >> 8 & 0xFF),
                     static_cast<std::uint8_t>(value & 0xFF)};
}

std::optional<TabletopShape> shape_named(std::string_view word) {
  const auto found =
    std::find_if(std::begin(shapes), std::end(shapes),
                 [&](const NamedShape& candidate) { return candidate.name == word; });
  if (found == std::end(shapes))
    return std::nullopt;
  return found->shape;
}

const std::vector<std::string>& colour_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& colour : colours)
      result.emplace_back(colour.name);
    return result;
  }();
  return names;
}

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& shape : shapes)
      result.emplace_back(shape.name);
    return result;
  }();
  return names;
}

std::size_t size_count(TabletopShape shape) {
  switch (shape) {
    case TabletopShape::box:
      return 3;
    case TabletopShape::rectangle:
    case TabletopShape::cylinder:
      return 2;
    default:
      return 1;
  }
}

Point3 size_of(TabletopShape shape, const std::vector<double>& given) {
  const auto number = [&](std::size_t i, double otherwise) {
    return i < given.size() ? given[i] : otherwise;
  };
  switch (shape) {
    case TabletopShape::cube:
    case TabletopShape::sphere: {
      const double side = number(0, solid_default);
      return {side, side, side};
    }
    case TabletopShape::cylinder: {
      const double diameter = number(0, solid_default);
      return {diameter, diameter, number(1, diameter * 4 / 3)};
    }
    case TabletopShape::box: {
      const double length = number(0, long_default);
      const double width = number(1, length / 2);
      return {length, width, number(2, width)};
    }
    case TabletopShape::rectangle: {
      const double length = number(0, long_default);
      return {length, number(1, length / 2), flat_thickness};
    }
    case TabletopShape::triangle: {
      const double side = number(0, flat_default);
      return {side, side * std::numbers::sqrt3 / 2, flat_thickness};
    }
    case TabletopShape::square:
    case TabletopShape::disc:
      break;
  }
  const double side = number(0, flat_default);
  return {side, side, flat_thickness};
}

} // namespace castor::vision
