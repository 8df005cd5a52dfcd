#include "castor/planning/motivation/table_layouts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace castor::planning::layouts {

namespace {

/// Between neighbours in a line, if that is less to be moved, metres.
constexpr double wide_gap = 0.06;

/// Between the centres of neighbours.
double spacing(const Things& things) {
  double radius = 0;
  for (const auto* x : things)
    radius = std::max(radius, x->radius);
  return 2 * radius + finger_gap;
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
                             const TablePoint& along) {
  std::vector<Offsets> result;
  for (const double gap : {finger_gap, wide_gap}) {
    auto& offsets = result.emplace_back();
    for (const double way : on_line(things, rank, gap))
      offsets.push_back({way * along.x, way * along.y});
  }
  return result;
}

} // namespace

TablePoint middle_of(const Things& things) {
  TablePoint sum;
  for (const auto* x : things) {
    sum.x += x->x;
    sum.y += x->y;
  }
  const auto count = static_cast<double>(things.size());
  return {sum.x / count, sum.y / count};
}

std::vector<TablePoint> places_around(const TablePoint& middle, const Offsets& offsets) {
  std::vector<TablePoint> result;
  for (const auto& x : offsets)
    result.push_back({middle.x + x.x, middle.y + x.y});
  return result;
}

std::vector<Offsets> in_row(const Things& things) {
  return in_line(things, ranks(things, [](const TableThing& t) { return t.x; }), {1, 0});
}

std::vector<Offsets> in_column(const Things& things) {
  return in_line(things, ranks(things, [](const TableThing& t) { return t.y; }), {0, 1});
}

std::vector<Offsets> in_row_as_named(const Things& things) {
  std::vector<std::size_t> rank(things.size());
  std::iota(rank.begin(), rank.end(), std::size_t{0});
  return in_line(things, rank, {1, 0});
}

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

Offsets in_ring(const Things& things, const TablePoint& middle) {
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

Offsets apart(const Things& things, const TablePoint& middle, double factor) {
  Offsets result;
  for (const auto* x : things)
    result.push_back({factor * (x->x - middle.x), factor * (x->y - middle.y)});
  return result;
}

} // namespace castor::planning::layouts
