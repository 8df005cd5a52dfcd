#include "castor/perception/spatial/table_parts.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace castor::spatial {

namespace {

constexpr std::string_view middle_of = "-middle";

/// How far from the middle of a side or an edge something may be that is said to be there, metres.
constexpr double middle_width = 0.08;

/// Signed distances from a disc's border, metres: positive inside.
struct Gaps {
  double left = 0;
  double right = 0;
  double front = 0;
  double back = 0;
};

Gaps gaps(const TableArea& area, const GroundPoint& centre, double radius) {
  return {centre.x - radius - area.low.x, area.high.x - centre.x - radius,
          centre.y - radius - area.low.y, area.high.y - centre.y - radius};
}

/// 1 at the edge, 0 at the width of one.
double at_edge(double gap) {
  return 1 - gap / edge_width;
}

/// How far a disc is beyond a line, by its size: 1 well beyond, 0 where it touches it.
double beyond(double distance, double radius) {
  return std::min(1.0, (distance - radius) / 0.02 + 0.01);
}

std::optional<std::pair<int, int>> strip(std::string_view part) {
  constexpr std::string_view prefix = "strip-";
  constexpr std::string_view of = "-of-";
  const auto middle = part.find(of);
  if (!part.starts_with(prefix) || middle == std::string_view::npos)
    return std::nullopt;
  const auto number = [](std::string_view text) {
    int result = 0;
    std::from_chars(text.data(), text.data() + text.size(), result);
    return result;
  };
  const auto which = number(part.substr(prefix.size(), middle - prefix.size()));
  const auto of_how_many = number(part.substr(middle + of.size()));
  if (which < 1 || of_how_many < which)
    return std::nullopt;
  return std::pair{which, of_how_many};
}

double fit_in_strip(const std::pair<int, int>& which, const TableArea& area,
                    const GroundPoint& centre) {
  const double width = (area.high.x - area.low.x) / which.second;
  const double middle = area.low.x + (which.first - 0.5) * width;
  return 1 - std::abs(centre.x - middle) / (width / 2);
}

/// Both on the side and, along it, about in the middle.
std::optional<double> fit_in_middle_of_side(std::string_view part, const TableArea& area,
                                            const GroundPoint& centre, double radius) {
  const auto way = way_to_side(part);
  const auto side = part.substr(0, part.size() - middle_of.size());
  const auto fit = fit_in_part(side, area, centre, radius);
  if (!way || !fit)
    return std::nullopt;
  const auto middle = area.middle();
  const double along = way->x == 0 ? centre.x - middle.x : centre.y - middle.y;
  return std::min(*fit, 1 - std::abs(along) / middle_width);
}

/// A quarter of the table: on both sides, the better the nearer to its corner.
double in_quarter(double fit, double beside, double beyond_gap, const TableArea& area) {
  constexpr double share = 0.7;
  const double width = (area.high.x - area.low.x) / 2;
  return fit <= 0 ? fit : fit * (1 - share * std::hypot(beside, beyond_gap) / width);
}

/// In front of who sits there: as near to the front edge as possible, along its middle half.
double at_hand(const TableArea& area, const GroundPoint& centre, double front_gap) {
  constexpr double to_side = 0.3; // per metre
  constexpr double beyond_middle = 6;
  const double off = std::abs(centre.x - area.middle().x);
  const double half = (area.high.x - area.low.x) / 4;
  return 1 - front_gap / hand_reach - to_side * std::min(off, half) -
         beyond_middle * std::max(off - half, 0.0);
}

} // namespace

bool is_middle_of_side(std::string_view part) {
  return part.ends_with(middle_of);
}

std::optional<GroundPoint> way_to_side(std::string_view part) {
  constexpr std::array<std::pair<std::string_view, GroundPoint>, 4> ways{
    {{"left", {-1, 0}}, {"right", {1, 0}}, {"front", {0, -1}}, {"back", {0, 1}}}};
  for (const std::string_view end : {middle_of, std::string_view{"-edge"}})
    if (part.ends_with(end))
      part.remove_suffix(end.size());
  for (const auto& [name, way] : ways)
    if (name == part)
      return way;
  return std::nullopt;
}

double clearness_on_side(const GroundPoint& way, const TableArea& area, const GroundPoint& centre) {
  constexpr double clear = 0.6;
  const auto middle = area.middle();
  const double towards = (centre.x - middle.x) * way.x + (centre.y - middle.y) * way.y;
  const double most = std::abs(way.x) * (area.high.x - area.low.x) / 2 +
                      std::abs(way.y) * (area.high.y - area.low.y) / 2;
  return std::clamp(towards / (clear * most), 0.0, 1.0);
}

std::optional<double> fit_in_part(std::string_view part, const TableArea& area,
                                  const GroundPoint& centre, double radius) {
  if (is_middle_of_side(part))
    return fit_in_middle_of_side(part, area, centre, radius);
  const auto gap = gaps(area, centre, radius);
  const auto middle = area.middle();
  const double nearest = std::min({gap.left, gap.right, gap.front, gap.back});
  const double left = at_edge(gap.left);
  const double right = at_edge(gap.right);
  const double front = at_edge(gap.front);
  const double back = at_edge(gap.back);
  const double on_left = beyond(middle.x - centre.x, radius);
  const double on_right = beyond(centre.x - middle.x, radius);
  const double in_front = beyond(middle.y - centre.y, radius);
  const double at_back = beyond(centre.y - middle.y, radius);
  const auto quarter = [&](double x, double x_gap, double y, double y_gap) {
    return in_quarter(std::min(x, y), x_gap, y_gap, area);
  };
  const std::array<std::pair<std::string_view, double>, 21> fits{
    {{"left", on_left},
     {"right", on_right},
     {"front", in_front},
     {"back", at_back},
     {"front-left", quarter(on_left, gap.left, in_front, gap.front)},
     {"front-right", quarter(on_right, gap.right, in_front, gap.front)},
     {"back-left", quarter(on_left, gap.left, at_back, gap.back)},
     {"back-right", quarter(on_right, gap.right, at_back, gap.back)},
     {"left-edge", left},
     {"right-edge", right},
     {"front-edge", front},
     {"back-edge", back},
     {"edge", at_edge(nearest)},
     {"front-left-corner", std::min(front, left)},
     {"front-right-corner", std::min(front, right)},
     {"back-left-corner", std::min(back, left)},
     {"back-right-corner", std::min(back, right)},
     {"corner", std::min(std::max(left, right), std::max(front, back))},
     {"centre",
      1 - std::hypot(centre.x - middle.x, centre.y - middle.y) / (radius + 1.5 * edge_width)},
     {"at-hand", at_hand(area, centre, gap.front)},
     {"table", 1}}};
  for (const auto& [name, fit] : fits)
    if (name == part)
      return fit;
  if (const auto which = strip(part))
    return fit_in_strip(*which, area, centre);
  return std::nullopt;
}

bool is_part_of_table(std::string_view part) {
  return fit_in_part(part, {{-1, -1}, {1, 1}}, {}, edge_width).has_value();
}

} // namespace castor::spatial
