#include "castor/planning/motivation/table_arrangements.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace castor::planning {

namespace {

/// Where an arm at the table reaches, from its middle; metres.
constexpr double half_width = 0.26;
constexpr double half_depth = 0.16;

/// Steps in which room is looked for, metres.
constexpr double step = 0.02;

/// Between neighbours in a line, if that is less to be moved, metres.
constexpr double wide_gap = 0.06;

/// How far from the middle of the table the rim of what is clearly on a side of it is, metres.
constexpr double clearly_beyond = 0.03;

/// What is farther from the middle is at an edge, as far as the arm reaches there, metres.
constexpr double edge_beside = 0.20;
constexpr double edge_beyond = 0.13;

struct Offset {
  double x = 0;
  double y = 0;
};

using Offsets = std::vector<Offset>;
using Things = std::vector<const TableThing*>;

/// Between the centres of neighbours.
double spacing(const Things& things) {
  double radius = 0;
  for (const auto* x : things)
    radius = std::max(radius, x->radius);
  return 2 * radius + finger_gap;
}

Offset middle_of(const Things& things) {
  Offset sum;
  for (const auto* x : things) {
    sum.x += x->x;
    sum.y += x->y;
  }
  const auto count = static_cast<double>(things.size());
  return {sum.x / count, sum.y / count};
}

/// Ranks of the things by a key, from the least.
template <class Key>
std::vector<std::size_t> ranks(const Things& things, Key key) {
  std::vector<std::size_t> order(things.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](auto i) { return key(*things[i]); });
  std::vector<std::size_t> result(things.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    result[order[rank]] = rank;
  return result;
}

/// Where they stand on a line, by their ranks, around its middle.
std::vector<double> on_line(const Things& things, const std::vector<std::size_t>& rank,
                            double gap) {
  std::vector<std::size_t> order(things.size());
  for (std::size_t i = 0; i < rank.size(); ++i)
    order[rank[i]] = i;
  std::vector<double> result(things.size());
  for (std::size_t k = 1; k < order.size(); ++k)
    result[order[k]] =
      result[order[k - 1]] + things[order[k - 1]]->radius + things[order[k]]->radius + gap;
  const double middle = result[order.back()] / 2;
  for (auto& x : result)
    x -= middle;
  return result;
}

/// With narrow and wider gaps.
/// @param along the line, of length 1
std::vector<Offsets> in_line(const Things& things, const std::vector<std::size_t>& rank,
                             const Offset& along) {
  std::vector<Offsets> result;
  for (const double gap : {finger_gap, wide_gap}) {
    auto& offsets = result.emplace_back();
    for (const double way : on_line(things, rank, gap))
      offsets.push_back({way * along.x, way * along.y});
  }
  return result;
}

std::vector<Offsets> in_row(const Things& things, const std::vector<std::size_t>& rank) {
  return in_line(things, rank, {1, 0});
}

std::vector<Offsets> in_column(const Things& things) {
  return in_line(things, ranks(things, [](const TableThing& t) { return t.y; }), {0, 1});
}

/// In the order in which they are given.
std::vector<std::size_t> as_named(const Things& things) {
  std::vector<std::size_t> result(things.size());
  std::iota(result.begin(), result.end(), std::size_t{0});
  return result;
}

/// The half that is nearer in front, each from left to right.
Offsets in_two_rows(const Things& things) {
  const auto depth = ranks(things, [](const TableThing& t) { return t.y; });
  const auto in_front = (things.size() + 1) / 2;
  const auto is_in_front = [&](std::size_t i) { return depth[i] < in_front; };
  Offsets result(things.size());
  for (const bool front : {true, false}) {
    Things row;
    for (std::size_t i = 0; i < things.size(); ++i)
      if (is_in_front(i) == front)
        row.push_back(things[i]);
    const auto rank = ranks(row, [](const TableThing& t) { return t.x; });
    for (std::size_t i = 0, next = 0; i < things.size(); ++i)
      if (is_in_front(i) == front) {
        const double along =
          static_cast<double>(rank[next++]) - (static_cast<double>(row.size()) - 1) / 2;
        result[i] = {along * spacing(things), (front ? -0.5 : 0.5) * spacing(things)};
      }
  }
  return result;
}

Offsets in_ring(const Things& things, const Offset& middle) {
  const auto rank =
    ranks(things, [&](const TableThing& t) { return std::atan2(t.y - middle.y, t.x - middle.x); });
  const double turn = 2 * std::numbers::pi / static_cast<double>(things.size());
  const double radius = spacing(things) / (2 * std::sin(turn / 2));
  Offsets result;
  for (const auto i : rank) {
    const double angle = -std::numbers::pi + (static_cast<double>(i) + 0.5) * turn;
    result.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return result;
}

Offsets apart(const Things& things, const Offset& middle, double factor) {
  Offsets result;
  for (const auto* x : things)
    result.push_back({factor * (x->x - middle.x), factor * (x->y - middle.y)});
  return result;
}

/// Whether that is clearly on a side of the table; everything is on none.
bool is_on_side(double x, double y, double radius, std::string_view side) {
  const double least = radius + clearly_beyond;
  return side.empty() || (side == "left" && x <= -least) || (side == "right" && x >= least) ||
         (side == "front" && y <= -least) || (side == "back" && y >= least) ||
         (side == "left-edge" && x <= -edge_beside) || (side == "right-edge" && x >= edge_beside) ||
         (side == "front-edge" && y <= -edge_beyond) || (side == "back-edge" && y >= edge_beyond);
}

/// What is asked for besides how they stand to each other.
struct Wanted {
  std::span<const TableThing> table;
  std::string_view side;
};

/// Whether all of them fit around a middle: on the table, and off what stands there now but the
/// thing itself, since one is moved after the other.
bool has_room(const Offset& middle, const Offsets& offsets, const Things& things,
              const Wanted& wanted) {
  constexpr double rounding = 1e-6;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double x = middle.x + offsets[i].x;
    const double y = middle.y + offsets[i].y;
    if (std::abs(x) > half_width || std::abs(y) > half_depth ||
        !is_on_side(x, y, things[i]->radius, wanted.side))
      return false;
    for (const auto& other : wanted.table)
      if (&other != things[i] && !other.is_held &&
          std::hypot(other.x - x, other.y - y) <
            other.radius + things[i]->radius + finger_gap - rounding)
        return false;
  }
  return true;
}

/// How much is to be moved, metres: those that are moved, how far, and to where arms reach less.
double effort(const Offset& middle, const Offsets& offsets, const Things& things) {
  constexpr double of_each = 0.1;
  constexpr double of_back = 2;
  double result = 0;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double way =
      std::hypot(middle.x + offsets[i].x - things[i]->x, middle.y + offsets[i].y - things[i]->y);
    const double back = std::max(0.0, middle.y + offsets[i].y);
    result += way < stands_right ? 0 : of_each + way + of_back * back;
  }
  return result;
}

/// Of one of these arrangements, around the middle with the least effort where there is room for
/// all.
std::vector<TableSpot> around(const std::vector<Offsets>& arrangements, const Things& things,
                              const Wanted& wanted) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<TableSpot> result;
  const auto try_around = [&](const Offset& middle, const Offsets& offsets) {
    const double needed = effort(middle, offsets, things);
    if (needed >= least || !has_room(middle, offsets, things, wanted))
      return;
    least = needed;
    result.clear();
    for (std::size_t i = 0; i < things.size(); ++i)
      result.push_back(
        {"spot-of-" + things[i]->object, middle.x + offsets[i].x, middle.y + offsets[i].y});
  };
  for (const auto& offsets : arrangements) {
    // One of them stays where it is.
    for (std::size_t i = 0; i < things.size(); ++i)
      try_around({things[i]->x - offsets[i].x, things[i]->y - offsets[i].y}, offsets);
    for (double x = -half_width; x <= half_width; x += step)
      for (double y = -half_depth; y <= half_depth; y += step)
        try_around({x, y}, offsets);
  }
  return result;
}

} // namespace

std::vector<TableSpot> arranged(std::string_view arrangement,
                                const std::vector<const TableThing*>& things,
                                std::span<const TableThing> table, std::string_view side) {
  const Wanted wanted{table, side};
  // "In a row along the left edge".
  const bool is_along_side =
    arrangement == "in-row" && (side == "left-edge" || side == "right-edge");
  if (is_along_side || arrangement == "in-column")
    return around(in_column(things), things, wanted);
  if (arrangement == "in-row")
    return around(in_row(things, ranks(things, [](const TableThing& t) { return t.x; })), things,
                  wanted);
  if (arrangement == "in-row-as-named")
    return around(in_row(things, as_named(things)), things, wanted);
  if (arrangement == "in-two-rows")
    return around({in_two_rows(things)}, things, wanted);
  const auto middle = middle_of(things);
  if (arrangement == "in-ring")
    return around({in_ring(things, middle)}, things, wanted);
  for (const double factor : {2.0, 1.7, 1.5, 1.3})
    if (auto result = around({apart(things, middle, factor)}, things, wanted); !result.empty())
      return result;
  return {};
}

} // namespace castor::planning
