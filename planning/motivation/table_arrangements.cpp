#include "castor/planning/motivation/table_arrangements.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace castor::planning {

namespace {

/// Between neighbours in a line, if that is less to be moved, metres.
constexpr double wide_gap = 0.06;

/// How far from the middle of the table the rim of what is clearly on a side of it is, metres.
constexpr double clearly_beyond = 0.03;

/// What is farther from the middle is at an edge, as far as the arm reaches there, metres.
constexpr double edge_beside = 0.20;
constexpr double edge_beyond = 0.13;

/// Of each thing from the middle of all.
using Offsets = std::vector<TablePoint>;
using Things = std::vector<const TableThing*>;

/// Between the centres of neighbours.
double spacing(const Things& things) {
  double radius = 0;
  for (const auto* x : things)
    radius = std::max(radius, x->radius);
  return 2 * radius + finger_gap;
}

TablePoint middle_of(const Things& things) {
  TablePoint sum;
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
                             const TablePoint& along) {
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

/// So far from the middle of the table a row or a column may be that goes through it, metres.
constexpr double through_middle = 0.03;

/// Whether that is clearly on a side of the table, or on a line through its middle; everything is
/// on none.
bool is_on_side(double x, double y, double radius, std::string_view side) {
  const double least = radius + clearly_beyond;
  return side.empty() || (side == "left" && x <= -least) || (side == "right" && x >= least) ||
         (side == "front" && y <= -least) || (side == "back" && y >= least) ||
         (side == "centre" && std::min(std::abs(x), std::abs(y)) <= through_middle) ||
         (side == "left-edge" && x <= -edge_beside) || (side == "right-edge" && x >= edge_beside) ||
         (side == "front-edge" && y <= -edge_beyond) || (side == "back-edge" && y >= edge_beyond);
}

/// What is asked for besides how they stand to each other.
struct Wanted {
  const TableRoom& room;
  std::string_view side;
};

double gap_between(const TablePoint& a, const TableThing& x, const TablePoint& b,
                   const TableThing& y) {
  return distance(a, b) - x.radius - y.radius;
}

/// Whether all things can be put at their places one after the other: each when those have left
/// that stand there now.
/// @param waits_for for each, indices of others
bool have_order(std::vector<std::vector<std::size_t>> waits_for) {
  for (std::size_t left = waits_for.size(); left > 0;) {
    const auto next = std::ranges::find_if(waits_for, &std::vector<std::size_t>::empty);
    if (next == waits_for.end())
      return false;
    const auto moved = static_cast<std::size_t>(next - waits_for.begin());
    // It has to wait for itself from now on, so that it is not found again.
    *next = {moved};
    for (std::size_t i = 0; i < waits_for.size(); ++i)
      if (i != moved)
        std::erase(waits_for[i], moved);
    --left;
  }
  return true;
}

/// Things around a middle.
class Placed {
public:
  Placed(const TablePoint& middle, const Offsets& offsets, const Things& things,
         const Wanted& wanted)
    : things_(things), wanted_(wanted) {
    for (const auto& x : offsets)
      at_.push_back({middle.x + x.x, middle.y + x.y});
  }

  /// How much is to be moved, metres: those that are moved, how far, and to where that is harder.
  /// Nothing if they do not fit there: on the side, where they can be put, and off all others.
  std::optional<double> effort() const {
    constexpr double of_each = 0.1;
    double result = 0;
    std::vector<std::vector<std::size_t>> waits_for(things_.size());
    for (std::size_t i = 0; i < things_.size(); ++i) {
      if (!is_on_side(at_[i].x, at_[i].y, things_[i]->radius, wanted_.side) || !is_apart(i))
        return std::nullopt;
      if (stays(i))
        continue;
      const auto there = wanted_.room.effort(*things_[i], at_[i]);
      if (!there || !is_free_of_others(i))
        return std::nullopt;
      result += of_each + distance(at_[i], place_of(*things_[i])) + *there;
      for (std::size_t j = 0; j < things_.size(); ++j)
        if (j != i && !stays(j) && is_too_near(i, place_of(*things_[j]), *things_[j]))
          waits_for[i].push_back(j);
    }
    return have_order(std::move(waits_for)) ? std::optional{result} : std::nullopt;
  }

  std::vector<TableSpot> spots() const {
    std::vector<TableSpot> result;
    for (std::size_t i = 0; i < things_.size(); ++i)
      result.push_back(spot_for(*things_[i], at_[i]));
    return result;
  }

private:
  bool stays(std::size_t i) const { return distance(at_[i], place_of(*things_[i])) < stands_right; }

  bool is_too_near(std::size_t i, const TablePoint& at, const TableThing& other) const {
    constexpr double rounding = 1e-6;
    return gap_between(at_[i], *things_[i], at, other) < finger_gap - rounding;
  }

  /// From where the things before it are to be.
  bool is_apart(std::size_t i) const {
    for (std::size_t j = 0; j < i; ++j)
      if (is_too_near(i, at_[j], *things_[j]))
        return false;
    return true;
  }

  /// From what is not moved.
  bool is_free_of_others(std::size_t i) const {
    return std::ranges::none_of(wanted_.room.things(), [&](const TableThing& x) {
      return !x.is_held && std::ranges::find(things_, &x) == things_.end() &&
             is_too_near(i, place_of(x), x);
    });
  }

  const Things& things_;
  const Wanted& wanted_;
  std::vector<TablePoint> at_;
};

/// Of one of these arrangements, around the middle with the least effort where there is room for
/// all.
std::vector<TableSpot> around(const std::vector<Offsets>& arrangements, const Things& things,
                              const Wanted& wanted) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<TableSpot> result;
  const auto try_around = [&](const TablePoint& middle, const Offsets& offsets) {
    const Placed placed(middle, offsets, things, wanted);
    if (const auto needed = placed.effort(); needed && *needed < least) {
      least = *needed;
      result = placed.spots();
    }
  };
  for (const auto& offsets : arrangements) {
    // One of them stays where it is.
    for (std::size_t i = 0; i < things.size(); ++i)
      try_around({things[i]->x - offsets[i].x, things[i]->y - offsets[i].y}, offsets);
    for (double x = -table_half_width; x <= table_half_width; x += room_step)
      for (double y = -table_half_depth; y <= table_half_depth; y += room_step)
        try_around({x, y}, offsets);
  }
  return result;
}

} // namespace

std::vector<TableSpot> arranged(std::string_view arrangement,
                                const std::vector<const TableThing*>& things, const TableRoom& room,
                                std::string_view side) {
  const Wanted wanted{room, side};
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
