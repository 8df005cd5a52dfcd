#include "castor/planning/motivation/table_goal_maker.hpp"
#include "castor/planning/motivation/table_layouts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

/// Goals that are about the corners of the table.
namespace castor::planning {

namespace {

constexpr std::array<std::string_view, 4> all_corners{"front-left-corner", "front-right-corner",
                                                      "back-left-corner", "back-right-corner"};

/// So far from the table's edges the rim of what is in a corner is, metres.
constexpr std::array<double, 3> from_edge{0, 0.02, 0.04};

/// From the very corner inwards.
std::vector<TablePoint> places_in(const TableThing& thing, std::string_view corner) {
  const double x_side = corner.find("left") == std::string_view::npos ? 1 : -1;
  const double y_side = corner.starts_with("front") ? -1 : 1;
  std::vector<TablePoint> result;
  for (const double x : from_edge)
    for (const double y : from_edge)
      result.push_back({x_side * (table_half_width - thing.radius - x),
                        y_side * (table_half_depth - thing.radius - y)});
  return result;
}

/// At the table's edges.
/// \param part a corner, or the middle of an edge
TablePoint outermost_place(const TableThing& thing, std::string_view part) {
  const double x = table_half_width - thing.radius;
  const double y = table_half_depth - thing.radius;
  if (part == "left-edge-middle")
    return {-x, 0};
  if (part == "right-edge-middle")
    return {x, 0};
  if (part == "front-edge-middle")
    return {0, -y};
  if (part == "back-edge-middle")
    return {0, y};
  return places_in(thing, part).front();
}

/// How much it takes to put a thing in a corner, as metres: how far it goes, and how hard that is
/// where it is easiest. Nothing if it cannot be put there.
std::optional<double> effort(const TableRoom& room, const TableThing& thing,
                             std::string_view corner) {
  std::optional<double> result;
  for (const auto& at : places_in(thing, corner))
    if (const auto there = room.effort(thing, at))
      result = std::min(result.value_or(std::numeric_limits<double>::infinity()),
                        *there + distance(at, place_of(thing)));
  return result;
}

/// A thing for each of the corners, or for as many as there are things and as can be reached, with
/// the least effort.
class CornerChoice {
public:
  using Things = std::vector<const TableThing*>;
  /// Null for a corner that nothing is put in.
  using Chosen = std::array<const TableThing*, all_corners.size()>;

  CornerChoice(const TableRoom& room, const Things& things) : things_(things) {
    for (const auto corner : all_corners) {
      auto& efforts = efforts_.emplace_back();
      for (const auto* x : things)
        efforts.push_back(effort(room, *x, corner));
    }
  }

  Chosen choose() {
    fill(0, 0);
    return best_;
  }

private:
  /// More than that of all others.
  static constexpr double of_empty_corner = 100;

  void fill(std::size_t corner, double effort) {
    if (effort >= least_)
      return;
    if (corner == all_corners.size()) {
      least_ = effort;
      best_ = chosen_;
      return;
    }
    for (std::size_t i = 0; i < things_.size(); ++i)
      if (efforts_[corner][i] && std::ranges::find(chosen_, things_[i]) == chosen_.end()) {
        chosen_[corner] = things_[i];
        fill(corner + 1, effort + *efforts_[corner][i]);
        chosen_[corner] = nullptr;
      }
    fill(corner + 1, effort + of_empty_corner);
  }

  const Things& things_;
  std::vector<std::vector<std::optional<double>>> efforts_;
  Chosen chosen_{};
  Chosen best_{};
  double least_ = std::numeric_limits<double>::infinity();
};

} // namespace

/// "One thing in each corner": those that are near.
TableGoal TableGoalMaker::put_in_each_corner() {
  if (things_.size() < 2)
    return refusal("That takes two things at least.");
  const auto chosen = CornerChoice{room_, things_}.choose();
  const auto wanted = std::min(things_.size(), all_corners.size());
  Things put;
  for (std::size_t i = 0; i < all_corners.size(); ++i)
    if (chosen[i] != nullptr) {
      put.push_back(chosen[i]);
      facts_.push_back(in_part(*chosen[i], std::string{all_corners[i]}));
    }
  if (put.size() < wanted)
    return refusal("I do not reach so many corners of the table with them.");
  things_ = std::move(put);
  return goal("put " + listed(things_) + " in a corner each" + but_what_is_kept(),
              listed(things_) + are(things_) + " in a corner each now" + but_what_is_kept());
}

/// Whether the arm can put it there at once, or it is not known at all where it can put it. What it
/// holds it can put down to take it in another way.
bool TableGoalMaker::is_corner_reached(const TableThing& x, std::string_view corner) const {
  const auto perhaps = effort_of(spatial::Reach::perhaps);
  const auto most = effort_of(x.is_held ? spatial::Reach::by_stop : spatial::Reach::direct);
  bool is_known = false;
  for (const auto& at : places_in(x, corner)) {
    const auto there = room_.effort(x, at);
    if (there && *there <= *most)
      return true;
    is_known = is_known || !room_.can_be_put(x, at) || (there && *there < *perhaps);
  }
  return !is_known;
}

/// Of the places at most 18 cm from a corner, or from the middle of an edge, the nearest where the
/// arm says that it can put the thing; nothing if it says so of none, or of a place in that part.
/// \param part such as "back-left-corner" or "right-edge-middle"
std::optional<TableSpot> TableGoalMaker::spot_as_near_to(const TableThing& x,
                                                         std::string_view part) const {
  auto& landings = room_.landings();
  if (!landings.has_arm())
    return std::nullopt;
  constexpr int most_steps = 6;
  constexpr double step = 0.03;
  constexpr double least_gap = 0.01;
  const auto wanted = outermost_place(x, part);
  std::vector<TablePoint> places;
  for (int i = -most_steps; i <= most_steps; ++i)
    for (int j = -most_steps; j <= most_steps; ++j) {
      const TablePoint at{wanted.x + i * step, wanted.y + j * step};
      if (distance(at, wanted) <= most_steps * step && room_.effort(x, at) &&
          room_.room_around(at, x, {&x}) >= least_gap)
        places.push_back(at);
    }
  std::ranges::sort(places, {}, [&](const TablePoint& at) { return distance(at, wanted); });
  // In that part, perhaps with a stop on the way.
  landings.begin(true);
  for (const auto& at : places)
    if (distance(at, wanted) < 2 * step && landings.lands(x, {at.x, at.y}))
      return std::nullopt;
  landings.begin(false);
  const auto found = std::ranges::find_if(places, [&](const TablePoint& at) {
    return landings.lands(x, {at.x, at.y});
  });
  const bool is_there = found != places.end() && distance(*found, wanted) >= 2 * step;
  return is_there ? std::optional{spot_for(x, *found)} : std::nullopt;
}

/// Where it is, if that is at the edge; else where the arm says that it can put the thing: nearest
/// to the edge, and of such places the nearest to where it is. Nothing if it says so of none, or
/// nobody says where it can. \param edge such as "back-edge"; nothing for other parts \param taken
/// where others are put
std::optional<TableGoalMaker::EdgeSpot>
TableGoalMaker::spot_at_edge(const TableThing& x, std::string_view edge,
                             std::span<const EdgeSpot> taken) const {
  constexpr double step = 0.03;
  constexpr double most_gap = 0.21;
  constexpr double least_room = 0.01;
  auto& landings = room_.landings();
  const bool is_side = edge == "left-edge" || edge == "right-edge";
  if (!landings.has_arm() || x.is_held || !(is_side || edge == "front-edge" || edge == "back-edge"))
    return std::nullopt;
  const double sign = edge == "left-edge" || edge == "front-edge" ? -1 : 1;
  const double outermost = (is_side ? table_half_width : table_half_depth) - x.radius;
  const double end = (is_side ? table_half_depth : table_half_width) - x.radius;
  const double here = is_side ? x.y : x.x;
  if (outermost - sign * (is_side ? x.x : x.y) < step)
    return EdgeSpot{{x.waypoint, x.x, x.y}, true, x.radius};
  struct Candidate {
    TablePoint at;
    double gap = 0;
  };
  std::vector<Candidate> candidates;
  for (double gap = 0; gap < most_gap; gap += step) {
    std::vector<double> along{std::clamp(here, -end, end)};
    for (double away = step; away < 2 * end; away += step)
      for (const double at : {here - away, here + away})
        if (std::abs(at) <= end)
          along.push_back(at);
    for (const double y : along) {
      const double across = sign * (outermost - gap);
      const TablePoint at = is_side ? TablePoint{across, y} : TablePoint{y, across};
      const bool is_free = std::ranges::none_of(taken, [&](const EdgeSpot& other) {
        return std::hypot(at.x - other.spot.x, at.y - other.spot.y) <
               x.radius + other.radius + finger_gap;
      });
      if (is_free && room_.effort(x, at) && room_.room_around(at, x, {&x}) >= least_room)
        candidates.push_back({at, gap});
    }
  }
  // Places with a stop on the way take long to find out: of those at an edge, one row is asked for.
  struct Rows {
    bool may_stop = false;
    double first = 0;
    double last = 0;
  };
  constexpr double slack = 1e-6;
  for (const auto& rows :
       {Rows{false, 0, step}, Rows{true, step, step}, Rows{false, 2 * step, 3 * step},
        Rows{true, 2 * step, 3 * step}, Rows{false, 4 * step, most_gap}}) {
    landings.begin(rows.may_stop);
    const auto found = std::ranges::find_if(candidates, [&](const Candidate& y) {
      return y.gap > rows.first - slack && y.gap < rows.last + slack &&
             landings.lands(x, {y.at.x, y.at.y});
    });
    if (found != candidates.end())
      return EdgeSpot{spot_for(x, found->at), found->gap < step + slack, x.radius};
  }
  return std::nullopt;
}

/// For each of the things; none if there is not one for all. Where others have left nothing to one,
/// that one chooses first.
std::vector<TableGoalMaker::EdgeSpot> TableGoalMaker::spots_at_edge(std::string_view edge) const {
  auto order = things_;
  for (std::size_t attempt = 0; attempt < things_.size(); ++attempt) {
    std::vector<EdgeSpot> spots;
    for (const auto* x : order) {
      auto spot = spot_at_edge(*x, edge, spots);
      if (!spot)
        break;
      spots.push_back(std::move(*spot));
    }
    if (spots.size() == order.size()) {
      std::vector<EdgeSpot> result;
      for (const auto* x : things_)
        result.push_back(spots[std::ranges::find(order, x) - order.begin()]);
      return result;
    }
    if (spots.empty())
      return {};
    std::rotate(order.begin(), order.begin() + spots.size(), order.begin() + spots.size() + 1);
  }
  return {};
}

/// Several things go into one corner: the one nearest to them that is reached, if any is.
std::string TableGoalMaker::corner_for_all() const {
  const TablePoint middle = layouts::middle_of(things_);
  const auto gap = [&](std::string_view corner) {
    return distance(places_in(*things_.front(), corner).front(), middle);
  };
  std::string_view best;
  for (const auto corner : all_corners)
    if (is_corner_reached(*things_.front(), corner) && (best.empty() || gap(corner) < gap(best)))
      best = corner;
  return std::string{best.empty() ? *std::ranges::min_element(all_corners, {}, gap) : best};
}

/// From that in which the last thing was put.
std::optional<std::string> TableGoalMaker::put_in_opposite_corner(std::string& where) {
  const auto last = std::ranges::find_if(table_, &TableThing::is_last_moved);
  constexpr double corner_width = 0.1;
  constexpr double corner_depth = 0.08;
  if (last == table_.end() || last->is_held || std::abs(last->x) < corner_width ||
      std::abs(last->y) < corner_depth)
    return "I do not know opposite to which corner: tell me the corner.";
  const DirectivePlace place{std::string{last->y < 0 ? "back" : "front"} +
                               (last->x < 0 ? "-right" : "-left") + "-corner",
                             {}};
  return put_in_part(place, where);
}

} // namespace castor::planning
