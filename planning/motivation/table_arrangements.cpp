#include "castor/planning/motivation/table_arrangements.hpp"

#include "castor/planning/motivation/table_layouts.hpp"
#include "castor/planning/motivation/table_placed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace castor::planning {

namespace {

using layouts::Offsets;
using layouts::Things;

/// How far from the middle of the table the rim of what is clearly on a side of it is, metres.
constexpr double clearly_beyond = 0.03;

/// What is farther from the middle is at an edge, as far as the arm reaches there, metres.
constexpr double edge_beside = 0.20;
constexpr double edge_beyond = 0.13;

/// What is so near to an edge, from its rim, is as near as anything is put there, metres; and how
/// much farther things may be moved for each metre that they get nearer.
constexpr double at_edge = 0.02;
constexpr double edge_share = 10;

/// So far from the middle of the table a row or a column may be that goes through it, metres.
constexpr double through_middle = 0.03;

/// Whether that is clearly on a side of the table, or on a line through its middle; everything is
/// on none.
bool is_on_side(double x, double y, double radius, std::string_view side) {
  const double least = radius + clearly_beyond;
  return side.empty() || (side == "left" && x <= -least) || (side == "right" && x >= least) ||
         (side == "front" && y <= -least) || (side == "back" && y >= least) ||
         (side == "centre" && std::min(std::abs(x), std::abs(y)) <= through_middle) ||
         (side == "towards-left-edge" && x <= 0) || (side == "towards-right-edge" && x >= 0) ||
         (side == "towards-front-edge" && y <= 0) || (side == "towards-back-edge" && y >= 0) ||
         (side == "left-edge" && x <= -edge_beside) || (side == "right-edge" && x >= edge_beside) ||
         (side == "front-edge" && y <= -edge_beyond) || (side == "back-edge" && y >= edge_beyond);
}

/// How much rather it would be nearer to the edge where it is to be, as metres that it is moved.
double off_edge(double x, double y, double radius, std::string_view side) {
  const bool is_across = side.ends_with("left-edge") || side.ends_with("right-edge");
  const bool is_along = side.ends_with("front-edge") || side.ends_with("back-edge");
  const double gap = is_across  ? table_half_width - std::abs(x) - radius
                     : is_along ? table_half_depth - std::abs(y) - radius
                                : 0;
  return edge_share * std::max(0.0, gap - at_edge);
}

/// What is asked for besides how they stand to each other.
struct Wanted {
  const TableRoom& room;
  std::string_view side;
};

struct Candidate {
  double effort = 0;
  std::vector<TablePoint> places;
};

/// Of one of these arrangements, around the middle with the least effort where there is room for
/// all, and where the arm can put all; rather without a stop between.
std::vector<TableSpot> around(const std::vector<Offsets>& arrangements, const Things& things,
                              const Wanted& wanted) {
  std::vector<Candidate> candidates;
  const auto try_around = [&](const TablePoint& middle, const Offsets& offsets) {
    auto places = layouts::places_around(middle, offsets);
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!is_on_side(places[i].x, places[i].y, things[i]->radius, wanted.side))
        return;
    const auto needed = TablePlaced(places, things, wanted.room).effort();
    if (!needed)
      return;
    double off = 0;
    for (std::size_t i = 0; i < things.size(); ++i)
      off = std::max(off, off_edge(places[i].x, places[i].y, things[i]->radius, wanted.side));
    candidates.push_back({*needed + off, std::move(places)});
  };
  for (const auto& offsets : arrangements) {
    // One of them stays where it is.
    for (std::size_t i = 0; i < things.size(); ++i)
      try_around({things[i]->x - offsets[i].x, things[i]->y - offsets[i].y}, offsets);
    for (double x = -table_half_width; x <= table_half_width; x += room_step)
      for (double y = -table_half_depth; y <= table_half_depth; y += room_step)
        try_around({x, y}, offsets);
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::effort);
  for (const bool may_put_between : {false, true}) {
    wanted.room.landings().begin(may_put_between);
    for (const auto& x : candidates)
      if (const TablePlaced placed(x.places, things, wanted.room); placed.land())
        return placed.spots();
  }
  return {};
}

} // namespace

std::vector<TableSpot> arranged(std::string_view arrangement,
                                const std::vector<const TableThing*>& things, const TableRoom& room,
                                std::string_view side) {
  const Wanted wanted{room, side};
  // "In a row along the left edge".
  const bool is_along_side =
    arrangement == "in-row" && (side.ends_with("left-edge") || side.ends_with("right-edge"));
  if (is_along_side || arrangement == "in-column")
    return around(layouts::in_column(things), things, wanted);
  if (arrangement == "in-row")
    return around(layouts::in_row(things), things, wanted);
  if (arrangement == "in-row-as-named")
    return around(layouts::in_row_as_named(things), things, wanted);
  if (arrangement == "in-two-rows")
    return around({layouts::in_two_rows(things)}, things, wanted);
  const auto middle = layouts::middle_of(things);
  if (arrangement == "in-ring")
    return around({layouts::in_ring(things, middle)}, things, wanted);
  for (const double factor : {2.0, 1.7, 1.5, 1.3})
    if (auto result = around({layouts::apart(things, middle, factor)}, things, wanted);
        !result.empty())
      return result;
  return {};
}

} // namespace castor::planning
