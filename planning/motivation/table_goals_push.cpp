#include "castor/planning/motivation/table_goal_maker.hpp"
#include "castor/planning/motivation/table_spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

/// Goals that have things pushed.
namespace castor::planning {

namespace {

/// How far things are pushed if nobody says how far, a little, and at least, metres.
constexpr double push_length = 0.08;
constexpr double little_push = 0.05;
constexpr double least_push = 0.03;

/// On all sides of what is pushed, metres.
constexpr double push_room = 0.012;

struct PushWay {
  std::string_view side;
  TablePoint along;
  std::string_view words;
};

constexpr std::array<PushWay, 4> push_ways{{{"left", {-1, 0}, "to the left"},
                                            {"right", {1, 0}, "to the right"},
                                            {"front", {0, -1}, "to the front"},
                                            {"back", {0, 1}, "to the back"}}};

/// "Left", "further-left", "slightly-left".
const PushWay* push_way(std::string_view relation) {
  for (const auto& way : push_ways)
    for (const std::string_view prefix : {"", "further-", "slightly-"})
      if (relation.size() == prefix.size() + way.side.size() && relation.starts_with(prefix) &&
          relation.ends_with(way.side))
        return &way;
  return nullptr;
}

/// Anywhere else, a little.
bool is_any_way(std::string_view relation) {
  return relation == "some-way" || relation == "aside" || relation == "elsewhere";
}

bool is_little(std::string_view relation) {
  return relation == "some-way" || relation.starts_with("slightly-");
}

} // namespace

/// Not to a place, but away from where it is.
bool TableGoalMaker::is_push_away() const {
  const auto is_away = [](const DirectivePlace& x) {
    return x.landmarks.empty() && (push_way(x.relation) != nullptr || is_any_way(x.relation));
  };
  return step_.places.empty() || (step_.places.size() == 1 && is_away(step_.places.front()));
}

TableGoal TableGoalMaker::push() {
  choose();
  if (const auto held = std::ranges::find_if(things_, &TableThing::is_held); held != things_.end())
    return refusal("I hold " + (*held)->words + ". Tell me to put it down first.");
  const auto place = step_.places.empty() ? DirectivePlace{} : step_.places.front();
  const double wanted = place.distance > 0          ? place.distance
                        : is_little(place.relation) ? little_push
                                                    : push_length;
  const auto* way = push_way(place.relation);
  if (way == nullptr)
    return push_anywhere(wanted);
  for (const auto* x : things_) {
    double distance = wanted;
    if (auto problem = push_one(*x, place, distance))
      return refusal(std::move(*problem));
    push_distance_ = std::max(push_distance_, distance);
  }
  const auto words =
    (place.distance > 0 ? ' ' + fine_centimetres(place.distance)
                        : std::string{is_little(place.relation) ? " a little" : ""}) +
    ' ' + std::string{way->words};
  return goal(done_before_taking() + "push " + listed(things_) + words + but_what_is_kept(),
              "I have pushed " + listed(things_) + words + but_what_is_kept());
}

/// The arm finds a way in which there is room.
TableGoal TableGoalMaker::push_anywhere(double distance) {
  // It pushes at least so far, and a little farther.
  constexpr double beyond = 0.01;
  push_distance_ = distance - beyond;
  for (const auto* x : things_)
    facts_.push_back("(pushed " + x->object + ')');
  return goal(done_before_taking() + "push " + listed(things_), "I have pushed " + listed(things_));
}

/// Straight, and where nobody has said how far, no farther than there is room.
/// @param distance becomes how far
/// \returns why it is impossible
std::optional<std::string> TableGoalMaker::push_one(const TableThing& x,
                                                    const DirectivePlace& place, double& distance) {
  const auto& way = *push_way(place.relation);
  const double least = place.distance > 0 ? distance : std::min(distance, least_push);
  const auto at = [&](double far) {
    return TablePoint{x.x + far * way.along.x, x.y + far * way.along.y};
  };
  const auto in_way = [&](double far) -> const TableThing* {
    for (double there = room_step; there < far + room_step / 2; there += room_step)
      for (const auto& other : table_)
        if (!other.is_held && other.object != x.object && other.on != x.object &&
            planning::distance(at(there), place_of(other)) < other.radius + x.radius + push_room &&
            planning::distance(at(there), place_of(other)) <
              planning::distance(place_of(x), place_of(other)))
          return &other;
    return nullptr;
  };
  constexpr double rounding = 1e-9;
  for (; distance > least - rounding; distance -= room_step)
    if (in_way(distance) == nullptr && room_.effort(x, at(distance))) {
      auto spot = spot_for(x, at(distance));
      facts_.push_back(at_waypoint(x, spot.name));
      spots_.push_back(std::move(spot));
      return std::nullopt;
    }
  const auto words = "I cannot push " + x.words + ' ' + std::string{way.words} + ": ";
  if (const auto* other = in_way(least))
    return words + other->words + " is in the way there. Take it away first.";
  const auto end = at(least);
  if (std::abs(end.x) + x.radius > table_half_width ||
      std::abs(end.y) + x.radius > table_half_depth)
    return words + "there is the edge of the table.";
  return words + "I do not reach so far with it.";
}

} // namespace castor::planning
