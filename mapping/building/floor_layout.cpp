#include "castor/mapping/building/floor_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace castor::mapping {

namespace {

constexpr double outer_thickness = 0.2;
constexpr double inner_thickness = 0.1;
/// Between a door and the corner of its room, from middle to middle of walls, metres.
constexpr double beside_door = 0.3;

constexpr std::array<std::string_view, 8> room_kinds{"office",  "kitchen", "lounge",  "storage",
                                                     "meeting", "lab",     "library", "printer"};

/// Rooms side by side between two upright walls, and where the corridor is.
struct Band {
  double left = 0;
  double right = 0;
  double bottom = 0;
  double top = 0;
  int rooms = 0;
  bool corridor_below = false;
  bool corridor_above = false;
};

class FloorPlan {
public:
  FloorPlan(const GeneratorOptions& options, SeededUniform& random)
    : options_(options), random_(random) {
    // nop
  }

  FloorLayout make() {
    // A block in the middle of a corridor takes two rooms at least.
    if (options_.rooms >= 6 && random_.chance(0.75))
      lay_out_ring(options_.rooms >= 9 && random_.chance(0.5) ? 2 : 1);
    else
      lay_out_spine();
    result_.building.name = "generated-" + std::to_string(options_.seed);
    add_room("corridor", "corridor", result_.corridor.front().middle());
    if (random_.chance(0.5))
      exchange_axes();
    return std::move(result_);
  }

private:
  double side() { return random_.between(options_.least_side, options_.greatest_side); }

  double corridor_width() {
    return to_centimetre(random_.between(options_.least_corridor, options_.greatest_corridor));
  }

  void wall(const Point2& from, const Point2& to, double thickness = inner_thickness) {
    result_.building.walls.push_back({{from, to}, thickness});
  }

  void outer_walls(double right, double top) {
    const std::array<Point2, 4> corners{{{0, 0}, {right, 0}, {right, top}, {0, top}}};
    for (std::size_t i = 0; i < corners.size(); ++i)
      wall(corners[i], corners[(i + 1) % corners.size()], outer_thickness);
  }

  void lay_out_spine() {
    const int below = options_.rooms / 2;
    const int above = options_.rooms - below;
    const double right = to_centimetre(std::max(above, below) * side());
    const double low = to_centimetre(side());
    const double high = low + corridor_width();
    const double top = to_centimetre(high + side());
    outer_walls(right, top);
    wall({0, low}, {right, low});
    wall({0, high}, {right, high});
    result_.corridor.push_back({{0, low}, {right, high}});
    fill({0, right, 0, low, below, false, true});
    fill({0, right, high, top, above, true, false});
  }

  void lay_out_ring(int blocks) {
    const int within = std::max(2 * blocks, options_.rooms / 3);
    const int below = (options_.rooms - within) / 2;
    const int above = options_.rooms - within - below;
    std::vector<double> uprights;
    for (int i = 0; i <= blocks; ++i)
      uprights.push_back(corridor_width());
    double corridors = 0;
    for (double x : uprights)
      corridors += x;
    const double room = side();
    const double right = to_centimetre(
      std::max(std::max(above, below) * room, corridors + within * std::max(room, 3.4)));
    const double low = to_centimetre(side());
    const double block_bottom = low + corridor_width();
    const double block_top = to_centimetre(block_bottom + side());
    const double high = block_top + corridor_width();
    const double top = to_centimetre(high + side());
    outer_walls(right, top);
    wall({0, low}, {right, low});
    wall({0, high}, {right, high});
    fill({0, right, 0, low, below, false, true});
    fill({0, right, high, top, above, true, false});
    result_.corridor.push_back({{0, low}, {right, block_bottom}});
    double x = 0;
    int left_over = within;
    for (int i = 0; i <= blocks; ++i) {
      const double block_left = to_centimetre(x + uprights[static_cast<std::size_t>(i)]);
      result_.corridor.push_back({{x, low}, {i < blocks ? block_left : right, high}});
      if (i == blocks)
        break;
      const int rooms = left_over / (blocks - i);
      left_over -= rooms;
      const double block_right =
        to_centimetre(i + 1 == blocks ? right - uprights.back()
                                      : block_left + (right - corridors) * rooms / within);
      wall({block_left, block_bottom}, {block_right, block_bottom});
      wall({block_right, block_bottom}, {block_right, block_top});
      wall({block_right, block_top}, {block_left, block_top});
      wall({block_left, block_top}, {block_left, block_bottom});
      fill({block_left, block_right, block_bottom, block_top, rooms, true, true});
      x = block_right;
    }
    result_.corridor.push_back({{0, block_top}, {right, high}});
  }

  void add_room(const std::string& name, const std::string& kind, const Point2& inside) {
    auto& room = result_.building.rooms.emplace_back();
    room.name = name;
    room.kind = kind;
    room.inside = inside;
  }

  /// Divides a band into rooms, whose widths differ by a third at most.
  void fill(const Band& band) {
    std::vector<double> shares;
    double sum = 0;
    for (int i = 0; i < band.rooms; ++i)
      sum += shares.emplace_back(random_.between(0.85, 1.15));
    double left = band.left;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const bool is_last = i + 1 == shares.size();
      const double right =
        is_last ? band.right : to_centimetre(left + (band.right - band.left) * shares[i] / sum);
      if (!is_last) {
        wall({right, band.bottom}, {right, band.top});
        if (random_.chance(options_.connecting_doors))
          door({right, band.bottom}, {right, band.top}, true);
      }
      room({{left, band.bottom}, {right, band.top}}, band);
      left = right;
    }
  }

  void room(const Rectangle& place, const Band& band) {
    const auto number = result_.building.rooms.size() + 1;
    const std::string kind{room_kinds[random_.below(room_kinds.size())]};
    add_room(kind + "-" + std::to_string(number), kind, place.middle());
    result_.rooms.push_back(place);
    const bool is_open = !random_.chance(options_.shut_doors);
    const bool is_between = band.corridor_below && band.corridor_above;
    const bool is_above = is_between ? random_.chance(0.5) : band.corridor_above;
    const auto corridor_door = [&](double y, bool opened) {
      door({place.low.x, y}, {place.high.x, y}, opened);
    };
    corridor_door(is_above ? place.high.y : place.low.y, is_open);
    if (is_between && random_.chance(options_.second_doors))
      corridor_door(is_above ? place.low.y : place.high.y, true);
  }

  /// Somewhere between the corners.
  void door(const Point2& from, const Point2& to, bool is_open) {
    Door x;
    x.width = to_centimetre(random_.between(options_.least_door, options_.greatest_door));
    x.is_open = is_open;
    const double whole = distance(from, to);
    const double aside = beside_door + x.width / 2;
    const auto at = point_at({from, to}, random_.between(aside, whole - aside) / whole);
    const Point2 middle{to_centimetre(at.x), to_centimetre(at.y)};
    x.opening = {middle, middle};
    x.name = "door-" + std::to_string(result_.building.doors.size() + 1);
    result_.building.doors.push_back(std::move(x));
  }

  void exchange_axes() {
    const auto exchange = [](Point2& p) { std::swap(p.x, p.y); };
    auto& building = result_.building;
    for (auto& x : building.walls) {
      exchange(x.middle.from);
      exchange(x.middle.to);
    }
    for (auto& x : building.doors) {
      exchange(x.opening.from);
      exchange(x.opening.to);
    }
    for (auto& x : building.rooms)
      exchange(x.inside);
    for (auto* rectangles : {&result_.rooms, &result_.corridor})
      for (auto& x : *rectangles) {
        exchange(x.low);
        exchange(x.high);
      }
  }

  const GeneratorOptions& options_;
  SeededUniform& random_;
  FloorLayout result_;
};

} // namespace

FloorLayout lay_out_floor(const GeneratorOptions& options, SeededUniform& random) {
  return FloorPlan(options, random).make();
}

} // namespace castor::mapping
