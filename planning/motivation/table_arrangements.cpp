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

Offsets in_line(const Things& things, double x, double y) {
  const auto rank = x > 0 ? ranks(things, [](const TableThing& t) { return t.x; })
                          : ranks(things, [](const TableThing& t) { return t.y; });
  Offsets result;
  for (const auto i : rank) {
    const double along = static_cast<double>(i) - (static_cast<double>(things.size()) - 1) / 2;
    result.push_back({along * x, along * y});
  }
  return result;
}

/// From left to right in the order in which they are given.
Offsets in_line_as_named(const Things& things) {
  Offsets result;
  for (std::size_t i = 0; i < things.size(); ++i)
    result.push_back(
      {spacing(things) * (static_cast<double>(i) - (static_cast<double>(things.size()) - 1) / 2),
       0});
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

/// Whether all of them fit around a middle: on the table, and off what stands there now but the
/// thing itself, since one is moved after the other.
bool has_room(const Offset& middle, const Offsets& offsets, const Things& things,
              std::span<const TableThing> table) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double x = middle.x + offsets[i].x;
    const double y = middle.y + offsets[i].y;
    if (std::abs(x) > half_width || std::abs(y) > half_depth)
      return false;
    for (const auto& other : table)
      if (&other != things[i] && !other.is_held &&
          std::hypot(other.x - x, other.y - y) < other.radius + things[i]->radius + finger_gap)
        return false;
  }
  return true;
}

/// The middle nearest to another one where there is room for all.
std::vector<TableSpot> around(const Offset& wanted, const Offsets& offsets, const Things& things,
                              std::span<const TableThing> table) {
  double least = std::numeric_limits<double>::infinity();
  Offset best;
  for (double x = -half_width; x <= half_width; x += step)
    for (double y = -half_depth; y <= half_depth; y += step)
      if (const double way = std::hypot(x - wanted.x, y - wanted.y);
          way < least && has_room({x, y}, offsets, things, table)) {
        least = way;
        best = {x, y};
      }
  std::vector<TableSpot> result;
  if (std::isinf(least))
    return result;
  for (std::size_t i = 0; i < things.size(); ++i)
    result.push_back(
      {"spot-of-" + things[i]->object, best.x + offsets[i].x, best.y + offsets[i].y});
  return result;
}

} // namespace

std::vector<TableSpot> arranged(std::string_view arrangement,
                                const std::vector<const TableThing*>& things,
                                std::span<const TableThing> table) {
  const auto middle = middle_of(things);
  if (arrangement == "in-row")
    return around(middle, in_line(things, spacing(things), 0), things, table);
  if (arrangement == "in-row-as-named")
    return around(middle, in_line_as_named(things), things, table);
  if (arrangement == "in-two-rows")
    return around(middle, in_two_rows(things), things, table);
  if (arrangement == "in-column")
    return around(middle, in_line(things, 0, spacing(things)), things, table);
  if (arrangement == "in-ring")
    return around(middle, in_ring(things, middle), things, table);
  for (const double factor : {2.0, 1.7, 1.5, 1.3})
    if (auto result = around(middle, apart(things, middle, factor), things, table); !result.empty())
      return result;
  return {};
}

} // namespace castor::planning
