#include "castor/mapping/building/building.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

constexpr std::array<std::pair<std::string_view, Colour>, 15> palette{
  {{"red", {200, 40, 40}},
   {"green", {50, 150, 60}},
   {"blue", {45, 80, 190}},
   {"yellow", {235, 205, 50}},
   {"orange", {235, 130, 30}},
   {"purple", {130, 60, 160}},
   {"pink", {235, 150, 180}},
   {"brown", {130, 85, 50}},
   {"wood", {186, 140, 90}},
   {"black", {35, 35, 35}},
   {"white", {240, 240, 235}},
   {"grey", {140, 140, 140}},
   {"silver", {190, 195, 200}},
   {"cyan", {70, 180, 190}},
   {"magenta", {200, 60, 150}}}};

std::optional<std::uint8_t> hexadecimal_byte(std::string_view digits) {
  std::uint8_t value = 0;
  auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc{} || end != digits.data() + digits.size())
    return std::nullopt;
  return value;
}

void include(Extent& x, const Point2& p) {
  x.low = {std::min(x.low.x, p.x), std::min(x.low.y, p.y)};
  x.high = {std::max(x.high.x, p.x), std::max(x.high.y, p.y)};
}

} // namespace

std::optional<Colour> colour_named(std::string_view word) {
  if (word.size() == 7 && word[0] == '#') {
    auto red = hexadecimal_byte(word.substr(1, 2));
    auto green = hexadecimal_byte(word.substr(3, 2));
    auto blue = hexadecimal_byte(word.substr(5, 2));
    if (red && green && blue)
      return Colour{*red, *green, *blue};
    return std::nullopt;
  }
  for (const auto& [name, colour] : palette)
    if (name == word)
      return colour;
  return std::nullopt;
}

const std::vector<std::string>& colour_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& [name, colour] : palette)
      result.emplace_back(name);
    return result;
  }();
  return names;
}

Extent extent(const Building& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Extent result{{infinity, infinity}, {-infinity, -infinity}};
  for (const auto& wall : x.walls)
    for (const auto& end : {wall.middle.from, wall.middle.to}) {
      include(result, {end.x - wall.thickness / 2, end.y - wall.thickness / 2});
      include(result, {end.x + wall.thickness / 2, end.y + wall.thickness / 2});
    }
  for (const auto& thing : x.furniture) {
    const auto& body = thing.body;
    const auto c = std::abs(std::cos(body.pose.heading));
    const auto n = std::abs(std::sin(body.pose.heading));
    const bool is_disc = body.shape == SolidShape::disc;
    const double across = (is_disc ? body.length : c * body.length + n * body.width) / 2;
    const double aside = (is_disc ? body.length : n * body.length + c * body.width) / 2;
    include(result, {body.pose.x - across, body.pose.y - aside});
    include(result, {body.pose.x + across, body.pose.y + aside});
  }
  return result.low.x > result.high.x ? Extent{} : result;
}

const Room* room_at(const Building& x, const Point2& p) {
  const Room* result = nullptr;
  for (const auto& room : x.rooms)
    if (contains(room.outline, p) &&
        std::ranges::none_of(room.holes, [&](const Polygon& hole) { return contains(hole, p); }) &&
        (!result || room.area < result->area))
      result = &room;
  return result;
}

double round_length(const Walker& x) {
  double result = 0;
  for (std::size_t i = 0; i + 1 < x.route.size(); ++i)
    result += distance(x.route[i], x.route[i + 1]);
  return x.is_loop ? result + distance(x.route.back(), x.route.front()) : 2 * result;
}

Point2 place_on_route(const Walker& x, double walked) {
  const double round = round_length(x);
  if (!(round > 0))
    return x.route.front();
  double left = std::fmod(walked, round);
  if (left < 0)
    left += round;
  if (!x.is_loop && left > round / 2)
    left = round - left;
  for (std::size_t i = 0; i < x.route.size(); ++i) {
    const Segment part{x.route[i], x.route[(i + 1) % x.route.size()]};
    const double way = length(part);
    if (left <= way && way > 0)
      return point_at(part, left / way);
    left -= way;
  }
  return x.route.front();
}

std::int64_t points_reached(const Walker& x, double walked) {
  const double round = round_length(x);
  if (!(round > 0))
    return 0;
  // Ways between the points of a round.
  std::vector<double> ways;
  for (std::size_t i = 0; i + 1 < x.route.size(); ++i)
    ways.push_back(distance(x.route[i], x.route[i + 1]));
  if (x.is_loop)
    ways.push_back(distance(x.route.back(), x.route.front()));
  else
    ways.insert(ways.end(), ways.rbegin(), ways.rend());
  const double rounds = std::floor(walked / round);
  auto result = static_cast<std::int64_t>(rounds) * static_cast<std::int64_t>(ways.size());
  double left = walked - rounds * round;
  for (const double way : ways) {
    left -= way;
    if (left < 0)
      break;
    ++result;
  }
  return result;
}

} // namespace castor::mapping
