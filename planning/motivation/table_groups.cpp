#include "castor/planning/motivation/table_groups.hpp"

#include "castor/planning/motivation/table_layouts.hpp"
#include "castor/planning/motivation/table_placed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace castor::planning {

namespace {

using layouts::Offsets;
using layouts::Things;

/// From the rim of a group to that of the next, rather the first, metres. Those of a group are
/// nearer to each other.
constexpr double group_gaps[] = {0.10, 0.07, 0.05};

/// What stands no farther from one of its group stands with it, metres.
constexpr double together = 0.045;

/// One of the places where a group can stand.
struct Standing {
  std::vector<TablePoint> places;
  /// Of the group's rims, from left to right.
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double effort = 0;
};

Standing standing(std::vector<TablePoint> places, const Things& things, double effort) {
  Standing result{std::move(places)};
  for (std::size_t i = 0; i < things.size(); ++i) {
    result.left = std::min(result.left, result.places[i].x - things[i]->radius);
    result.right = std::max(result.right, result.places[i].x + things[i]->radius);
  }
  result.effort = effort;
  return result;
}

/// Whether each can be reached from the first by steps from one to another that stands with it.
bool stand_together(const Things& things) {
  Things reached{things.front()};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const auto* x : things)
      if (gap_between(*reached[i], *x) <= together &&
          std::ranges::find(reached, x) == reached.end())
        reached.push_back(x);
  return reached.size() == things.size();
}

/// @param all of all groups: where they stand now they need not be in the way
std::vector<Standing> all_standings(const Things& things, const Things& all,
                                    const TableRoom& room) {
  std::vector<Standing> result;
  const auto add = [&](std::vector<TablePoint> places) {
    const TablePlaced placed(places, things, room, all);
    if (const auto effort = placed.effort())
      result.push_back(standing(std::move(places), things, *effort));
  };
  std::vector<TablePoint> now;
  for (const auto* x : things)
    now.push_back(place_of(*x));
  if (stand_together(things))
    add(now);
  // Only the narrow ones: the others are not together.
  std::vector<Offsets> offsets{layouts::in_column(things).front()};
  if (things.size() > 1)
    offsets.push_back(layouts::in_row(things).front());
  if (things.size() > 2)
    offsets.push_back(layouts::in_two_rows(things));
  for (const auto& x : offsets) {
    for (std::size_t i = 0; i < things.size(); ++i)
      add(layouts::places_around({now[i].x - x[i].x, now[i].y - x[i].y}, x));
    for (double a = -table_half_width; a <= table_half_width; a += room_step)
      for (double b = -table_half_depth; b <= table_half_depth; b += room_step)
        add(layouts::places_around({a, b}, x));
  }
  return result;
}

/// The standings with the least effort, one of each group, each right of the one before.
class LeftToRight {
public:
  LeftToRight(const std::vector<std::vector<Standing>>& groups, double gap)
    : groups_(groups), gap_(gap) {
    for (const auto& standings : groups)
      add(standings);
  }

  /// Empty if there is no room.
  std::vector<const Standing*> best() const {
    const auto& last = best_.back();
    const auto end = std::ranges::min_element(last, {}, &Best::effort);
    std::vector<const Standing*> result;
    if (std::isinf(end->effort))
      return result;
    auto column = static_cast<std::size_t>(end - last.begin());
    for (std::size_t i = groups_.size(); i-- > 0; column = best_[i][column].before)
      result.insert(result.begin(), best_[i][column].standing);
    return result;
  }

private:
  /// Of all that end no farther right than a column.
  struct Best {
    double effort = std::numeric_limits<double>::infinity();
    const Standing* standing = nullptr;
    std::size_t before = 0;
  };

  static constexpr double column_width = 0.005;
  static constexpr std::size_t columns =
    static_cast<std::size_t>(2 * table_half_width / column_width) + 2;

  static double column_of(double x) { return (x + table_half_width) / column_width; }

  void add(const std::vector<Standing>& standings) {
    std::vector<Best> next(columns);
    for (const auto& x : standings) {
      Best here{x.effort, &x, 0};
      if (!best_.empty()) {
        const double before = std::floor(column_of(x.left - gap_) + 1e-6);
        if (before < 0)
          continue;
        here.before = std::min(static_cast<std::size_t>(before), columns - 1);
        here.effort += best_.back()[here.before].effort;
      }
      const double end = std::ceil(std::max(column_of(x.right) - 1e-6, 0.0));
      auto& best = next[std::min(static_cast<std::size_t>(end), columns - 1)];
      if (here.effort < best.effort)
        best = here;
    }
    for (std::size_t i = 1; i < columns; ++i)
      if (next[i - 1].effort < next[i].effort)
        next[i] = next[i - 1];
    best_.push_back(std::move(next));
  }

  const std::vector<std::vector<Standing>>& groups_;
  double gap_;
  std::vector<std::vector<Best>> best_;
};

/// Where there is room; what the arm has said to be beyond its reach counts as such.
std::optional<TablePlaced> placed_in_groups(const std::vector<Things>& groups, const Things& all,
                                            const TableRoom& room) {
  std::vector<std::vector<Standing>> standings;
  for (const auto& group : groups)
    standings.push_back(all_standings(group, all, room));
  for (const double gap : group_gaps) {
    std::vector<TablePoint> places;
    for (const auto* x : LeftToRight{standings, gap}.best())
      places.insert(places.end(), x->places.begin(), x->places.end());
    if (places.empty())
      continue;
    TablePlaced placed(std::move(places), all, room);
    if (placed.effort())
      return placed;
  }
  return std::nullopt;
}

} // namespace

std::vector<TableSpot> grouped(const std::vector<Things>& groups, const TableRoom& room) {
  constexpr int most_tries = 40;
  Things all;
  for (const auto& group : groups)
    all.insert(all.end(), group.begin(), group.end());
  for (const bool may_put_between : {false, true}) {
    room.landings().begin(may_put_between);
    for (int i = 0; i < most_tries; ++i) {
      const auto placed = placed_in_groups(groups, all, room);
      if (!placed)
        break;
      if (placed->land())
        return placed->spots();
    }
  }
  return {};
}

} // namespace castor::planning
