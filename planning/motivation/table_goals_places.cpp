#include "castor/planning/motivation/table_arrangements.hpp"
#include "castor/planning/motivation/table_goal_maker.hpp"
#include "castor/planning/motivation/table_spots.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

/// Goals that are about places of things.
namespace castor::planning {

namespace {

std::string_view shape_of(const TableThing& x) {
  const auto shape = x.qualities.find("shape");
  return shape == x.qualities.end() ? std::string_view{} : shape->second;
}

bool is_round(const TableThing& x) {
  return shape_of(x) == "sphere";
}

/// Nothing can be put into a solid.
bool is_solid(const TableThing& x) {
  return is_round(x) || shape_of(x) == "cube" || shape_of(x) == "cylinder";
}

/// "At the front, in the middle": parts that are said together are met together.
std::vector<communication::DirectivePlace>
with_middles_of_sides(std::vector<communication::DirectivePlace> places) {
  const auto is_centre = [](const auto& x) { return x.relation == "centre"; };
  const auto centre = std::ranges::find_if(places, is_centre);
  const auto side = std::ranges::find_if(places, [](const auto& x) {
    return x.landmarks.empty() && !words_for(part_words, x.relation + "-middle").empty();
  });
  if (centre == places.end() || side == places.end())
    return places;
  side->relation += "-middle";
  places.erase(centre);
  return places;
}

/// Clear of the lines through the middle of the table.
/// \param quarter such as "back-left"
bool is_in_quarter(const TableThing& x, std::string_view quarter) {
  const auto is_beyond = [&](double along, std::string_view towards_less) {
    return quarter.find(towards_less) != std::string_view::npos ? along < -x.radius
                                                                : along > x.radius;
  };
  return !x.is_held && is_beyond(x.x, "left") && is_beyond(x.y, "front");
}

bool is_shift(const communication::DirectivePlace& x) {
  return std::ranges::find(shifts, x.relation, &Shift::relation) != std::end(shifts);
}

/// "10 cm to the right and 5 cm to the back."
Shifted further_along(const std::vector<communication::DirectivePlace>& places) {
  Shifted result;
  for (const auto& place : places) {
    const auto* shift = std::ranges::find(shifts, place.relation, &Shift::relation);
    if (shift == std::end(shifts))
      continue;
    const double length = place.distance > 0 ? place.distance / std::hypot(shift->x, shift->y) : 1;
    result.x += length * shift->x;
    result.y += length * shift->y;
    result.words += result.words.empty() ? "" : " and";
    if (place.distance > 0)
      result.words += ' ' + fine_centimetres(place.distance);
    result.words += ' ' + std::string{shift->words};
  }
  return result;
}

bool is_measured_place(const communication::DirectivePlace& x) {
  const bool has_landmarks = !x.landmarks.empty() || landmarks_needed(x.relation) == 0;
  return is_measured(x.relation, has_landmarks ? x.distance : 0);
}

} // namespace

TableGoal TableGoalMaker::put() {
  // Whatever their number, a thing for each.
  if (std::ranges::find(step_.places, "each-corner", &DirectivePlace::relation) !=
      step_.places.end())
    return put_in_each_corner();
  choose();
  const auto verb = (step_.action == "Push" ? "push " : "put ") + listed(things_);
  std::string where;
  const auto places = with_middles_of_sides(step_.places);
  const auto part = std::ranges::find_if(
    places, [](const DirectivePlace& x) { return !words_for(part_words, x.relation).empty(); });
  // Several ways are gone at once.
  const auto first_shift = std::ranges::find_if(places, is_shift);
  for (const auto& place : places) {
    if (communication::is_arrangement(place.relation)) {
      if (part == places.end())
        return arrange(place.relation);
      auto goal =
        arrange_at(place.relation, part->relation.substr(0, part->relation.find("-middle")));
      if (goal.wish == TableWish::goal || room_.landings().most_often_beyond() != nullptr)
        return goal;
      // "In a row along the edge": at an edge they are in a row.
      continue;
    }
    if (place.relation == "both-sides")
      return put_on_both_sides(place);
    if (place.relation == "where" || place.relation == "where-before")
      return put_where_another_is(place, verb);
    if (is_shift(place) && &place != &*first_shift)
      continue;
    auto problem = is_shift(place)              ? put_further(further_along(places), where)
                   : place.relation == "on-top" ? put_on_top(where)
                   : is_measured_place(place)   ? put_at_spot(place, where)
                   : place.landmarks.empty()    ? put_in_part(place, where)
                                                : put_at_landmarks(place, where);
    if (problem)
      return refusal(*problem);
  }
  return goal(done_before_taking() + verb + where + but_what_is_kept(),
              listed(things_) + are(things_) + where + " now" + but_what_is_kept());
}

/// In a row, a column or a ring, or far from each other.
/// @param side of the table, or empty
TableGoal TableGoalMaker::arrange(const std::string& arrangement, const std::string& side) {
  auto words = std::string{words_for(arrangement_words, arrangement)};
  constexpr std::string_view towards = "towards-";
  constexpr std::string_view at = "at ";
  if (side.starts_with(towards)) {
    auto part = words_for(part_words, side.substr(towards.size()));
    part.remove_prefix(part.starts_with(at) ? at.size() : 0);
    words += " as near to " + std::string{part} + " as I reach with them";
  } else if (!side.empty())
    words += ' ' + std::string{words_for(part_words, side)};
  if (things_.size() < 2)
    return refusal("That takes two things at least.");
  if (arrangement == "in-two-rows" && things_.size() < 4)
    return refusal("Two rows take four things at least.");
  if (arrangement == "in-ring" && things_.size() < 3)
    return refusal("A circle takes three things at least.");
  if (const auto held = std::ranges::find_if(things_, &TableThing::is_held); held != things_.end())
    return refusal("I hold " + (*held)->words + ". Tell me to put it down first.");
  spots_ = arranged(arrangement, things_, room_, side);
  const auto* beyond = room_.landings().most_often_beyond();
  if (spots_.empty() && beyond != nullptr)
    return refusal("I cannot put them " + words + ": I do not reach any such place with " +
                   beyond->words + ". Tell me another place, or fewer things.");
  if (spots_.empty())
    return refusal("There is no room to put them " + words +
                   ". Take something away first, or tell me fewer things.");
  stand_at(std::move(spots_));
  return goal("put " + listed(things_) + ' ' + words + but_what_is_kept(),
              listed(things_) + are(things_) + ' ' + words + " now" + but_what_is_kept());
}

/// At a side or an edge of the table, or as near to it as there is room and the arm gets.
TableGoal TableGoalMaker::arrange_at(const std::string& arrangement, const std::string& side) {
  auto goal = arrange(arrangement, side);
  if (goal.wish == TableWish::goal || side.empty())
    return goal;
  const auto edge = side.find("-edge");
  const bool is_edge = edge != std::string::npos;
  if (is_edge)
    goal = arrange(arrangement, side.substr(0, edge));
  if (goal.wish == TableWish::goal || room_.landings().most_often_beyond() == nullptr)
    return goal;
  auto towards = arrange(arrangement, "towards-" + side + (is_edge ? "" : "-edge"));
  return towards.wish == TableWish::goal ? towards : goal;
}

/// Each of the things at its spot; what is there stays.
void TableGoalMaker::stand_at(std::vector<TableSpot> spots) {
  spots_.clear();
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const auto& x = *things_[i];
    const bool is_right = std::hypot(spots[i].x - x.x, spots[i].y - x.y) < stands_right;
    facts_.push_back(at_waypoint(x, is_right ? x.waypoint : spots[i].name));
    if (!is_right)
      spots_.push_back(std::move(spots[i]));
  }
}

/// In the place of something else, which has to leave it, or where that was before.
TableGoal TableGoalMaker::put_where_another_is(const DirectivePlace& place,
                                               const std::string& verb) {
  const auto* other = place.landmarks.size() == 1 ? thing(place.landmarks.front()) : nullptr;
  if (other == nullptr)
    return refusal(place.landmarks.size() == 1 ? "I do not see all of that any more."
                                               : "It can be in one place only.");
  if (things_.size() > 1)
    return refusal("There is room for one thing only.");
  const auto& x = *things_.front();
  const bool was = place.relation == "where-before";
  const auto& waypoint = was ? other->waypoint_before : other->waypoint;
  if (other->is_kept && !was)
    return refusal("I am not to touch " + other->words + '.');
  if (was && waypoint.empty())
    return refusal("I do not know where " + other->words + " was before.");
  if (other->is_held && !was)
    return refusal("I hold " + other->words + ". Tell me to put it down first.");
  if (auto problem = was ? std::nullopt : beyond_reach(x, *other))
    return refusal(std::move(*problem));
  facts_.push_back(at_waypoint(x, waypoint));
  ++places_;
  return goal(done_before_taking() + verb + " where " + other->words + (was ? " was" : " is"),
              x.words + " is where " + other->words + " was");
}

/// \returns why it is impossible
std::optional<std::string> TableGoalMaker::put_further(const Shifted& way, std::string& where) {
  for (const auto* x : things_) {
    if (x->is_held)
      return "I hold " + x->words + ": tell me where to put it.";
    auto spot = spot_for(*x, {x->x + way.x, x->y + way.y});
    if (!is_on_table(spot.x, spot.y))
      return "There " + x->words + " would not be on the table any more.";
    if (!room_.can_be_put(*x, {spot.x, spot.y}))
      return "I do not reach there with " + x->words + ".";
    for (const auto& other : table_)
      if (!other.is_held && std::ranges::find(things_, &other) == things_.end() &&
          std::hypot(other.x - spot.x, other.y - spot.y) < other.radius + x->radius)
        return sentence(other.words + " is in the way there") + " Take it away first.";
    facts_.push_back(at_waypoint(*x, spot.name));
    spots_.push_back(std::move(spot));
  }
  where += way.words;
  return std::nullopt;
}

/// \returns why it is impossible
std::optional<std::string> TableGoalMaker::put_in_part(const DirectivePlace& place,
                                                       std::string& where) {
  if (place.relation == "opposite-corner")
    return put_in_opposite_corner(where);
  if (place.relation == "some-way")
    return "I do not know which way: tell me to the left, to the right, to the front or back.";
  const auto words = words_for(part_words, place.relation);
  if (words.empty())
    return "I do not know where that is: tell me a part of the table, or a thing that is there.";
  // There is room in a corner for one thing: the others are beside it.
  const bool is_one_corner = place.relation == "corner" && things_.size() > 1;
  auto part = is_one_corner ? corner_for_all() : place.relation;
  // As near to it as can be reached.
  constexpr std::string_view corner = "-corner";
  const auto reaches = [&](const TableThing* x) { return is_corner_reached(*x, part); };
  const bool is_in_corner =
    !part.ends_with(corner) ||
    (is_one_corner ? reaches(things_.front()) : std::ranges::all_of(things_, reaches));
  const auto wanted = words_for(part_words, part);
  const auto quarter = is_in_corner ? part : part.substr(0, part.size() - corner.size());
  if (!is_in_corner &&
      std::ranges::all_of(things_, [&](const auto* x) { return is_in_quarter(*x, quarter); }))
    return "The corner is out of reach with " + listed(things_) + ", which" + are(things_) + ' ' +
           std::string{words_for(part_words, quarter)} + " already.";
  if (const auto spots = spots_at_edge(part); !spots.empty()) {
    constexpr std::string_view at = "at ";
    const auto there = std::ranges::count_if(spots, &EdgeSpot::is_at_edge);
    if (there > 0)
      where += ' ' + std::string{wanted};
    if (there > 0 && there < std::ssize(spots))
      where += " or as near to it as I reach";
    else if (there == 0)
      where += " as near to " + std::string{wanted.substr(at.size())} + " as I reach with " +
               (things_.size() == 1 ? "it" : "them");
    for (std::size_t i = 0; i < things_.size(); ++i) {
      facts_.push_back(at_waypoint(*things_[i], spots[i].spot.name));
      if (spots[i].spot.name != things_[i]->waypoint)
        spots_.push_back(spots[i].spot);
    }
    return std::nullopt;
  }
  const bool may_be_beyond = !is_in_corner || part.ends_with("-edge-middle");
  const auto nearest =
    may_be_beyond && things_.size() == 1 ? spot_as_near_to(*things_.front(), part) : std::nullopt;
  if (!nearest && !is_in_corner && room_.landings().most_often_beyond() == things_.front())
    return "I reach no place near there with " + things_.front()->words +
           ". Tell me another place.";
  if (nearest || !is_in_corner) {
    constexpr std::string_view in = "in ";
    where += " as near to " + std::string{wanted.substr(in.size())} + " as I reach with " +
             (things_.size() == 1 ? "it" : "them");
  } else if (const auto* other = part == "centre" ? thing_in_middle() : nullptr)
    where += " as near to the middle as there is room beside " + other->words;
  else
    where += ' ' + std::string{wanted};
  if (nearest) {
    facts_.push_back(at_waypoint(*things_.front(), nearest->name));
    spots_.push_back(*nearest);
    return std::nullopt;
  }
  part = quarter;
  for (const auto* x : things_)
    if (is_one_corner && x != things_.front()) {
      facts_.push_back("(near " + x->object + ' ' + things_.front()->object + ')');
      ++places_;
    } else
      facts_.push_back(in_part(*x, part));
  return std::nullopt;
}

/// What leaves no room in the very middle for the one thing that is put there; null if there is
/// none.
const TableThing* TableGoalMaker::thing_in_middle() const {
  if (things_.size() != 1)
    return nullptr;
  const auto is_in_way = [&](const TableThing& other) {
    return &other != things_.front() && !other.is_held && other.on.empty() &&
           gap_between(*things_.front(), {}, other, place_of(other)) < 0;
  };
  const auto found = std::ranges::find_if(table_, is_in_way);
  return found == table_.end() ? nullptr : &*found;
}

std::optional<std::string> TableGoalMaker::put_at_landmarks(const DirectivePlace& place,
                                                            std::string& where) {
  const auto* known = std::ranges::find(relation_words, place.relation, &RelationWords::relation);
  if (known == std::end(relation_words))
    return "I cannot put things " + place.relation + " others.";
  Things landmarks;
  for (const auto& proxy : place.landmarks) {
    landmarks.push_back(thing(proxy));
    if (landmarks.back() == nullptr)
      return "I do not see all of that any more.";
  }
  if (known->predicate == "on")
    landmarks = without_lower_ones(landmarks);
  for (const auto* x : things_)
    if (std::ranges::find(landmarks, x) != landmarks.end())
      return "I cannot put " + x->words + ' ' + std::string{known->words} + " itself.";
  if (place.relation == "in")
    for (const auto* x : landmarks)
      if (is_solid(*x))
        return "I see no opening in " + x->words + ": I can put things on it, but not into it.";
  where += ' ' + std::string{known->words} + ' ' + listed(landmarks);
  if (known->predicate != "on")
    landmarks = without_upper_ones(std::move(landmarks));
  places_ += things_.size();
  if (place.relation == "between" && landmarks.size() != 2)
    return "Between two things, but not between " + std::to_string(landmarks.size()) + '.';
  if (known->predicate == "on")
    if (auto problem = put_on(landmarks))
      return problem;
  for (const auto* x : things_) {
    const auto head = '(' + std::string{known->predicate} + ' ' + x->object;
    if (place.relation == "between")
      facts_.push_back(head + ' ' + landmarks[0]->object + ' ' + landmarks[1]->object + ')');
    else
      for (const auto* landmark : landmarks)
        facts_.push_back(head + ' ' + landmark->object + ')');
  }
  return std::nullopt;
}

/// What a thing stands on, and not the thing itself, is beside others.
TableGoalMaker::Things TableGoalMaker::without_upper_ones(Things landmarks) const {
  Things result;
  for (const auto* x : landmarks) {
    const auto below = [&] { return std::ranges::find(table_, x->on, &TableThing::object); };
    for (auto base = below(); !x->is_held && base != table_.end(); base = below())
      x = &*base;
    if (std::ranges::find(result, x) == result.end())
      result.push_back(x);
  }
  return result;
}

/// "On both of them", where one stands on the other: on the upper one.
TableGoalMaker::Things TableGoalMaker::without_lower_ones(const Things& landmarks) {
  Things result;
  for (const auto* x : landmarks)
    if (std::ranges::none_of(landmarks, [&](const auto* y) { return y->on == x->object; }))
      result.push_back(x);
  return result;
}

/// Why it cannot be put in the place of another thing.
std::optional<std::string> TableGoalMaker::beyond_reach(const TableThing& x,
                                                        const TableThing& other) const {
  auto why = exchange_ ? exchange_(x, other) : std::nullopt;
  if (!why)
    why = room_.can_be_put(x, place_of(other)) ? "" : "I do not reach there with it";
  if (why->empty())
    return std::nullopt;
  return "I cannot put " + x.words + " where " + other.words + " is: " + *why + '.';
}

/// A place beside that of another thing, where the arm says that it can put this one when both have
/// left.
std::optional<TableSpot> TableGoalMaker::spot_nearly_at(const TableThing& x,
                                                        const TableThing& other) const {
  constexpr int directions = 8;
  constexpr double narrow_gap = 0.01; // metres
  std::vector<spatial::GroundPoint> points;
  for (const double away : {0.015, 0.025})
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / directions;
      const TablePoint at{other.x + away * std::cos(angle), other.y + away * std::sin(angle)};
      if (room_.effort(x, at) && room_.room_around(at, x, {&other}) >= narrow_gap &&
          gap_between(x, at, other, place_of(x)) >= narrow_gap)
        points.push_back({at.x, at.y});
    }
  const auto found = room_.landings().first_of(x, points);
  return found ? std::optional{spot_for(x, {found->x, found->y})} : std::nullopt;
}

/// ", or on the cube", where one is free.
std::string TableGoalMaker::on_another(const TableThing& below) const {
  for (const auto& x : table_) {
    const bool is_asked = std::ranges::find(things_, &x) != things_.end();
    const bool is_loaded = std::ranges::find(table_, x.object, &TableThing::on) != table_.end();
    if (&x != &below && !is_asked && !is_loaded && !is_round(x) && !x.is_held && !x.is_kept &&
        !x.is_kept_clear)
      return ", or on " + x.words;
  }
  return {};
}

std::optional<std::string> TableGoalMaker::put_on(const Things& landmarks) const {
  if (landmarks.size() > 1)
    return "It can stand on one thing only.";
  if (things_.size() > 1)
    return "There is room for one thing only.";
  const auto& below = *landmarks.front();
  if (is_round(below))
    return sentence(below.words + " is round: nothing stays on it. I can put " + listed(things_) +
                    " next to it" + on_another(below));
  if (below.is_kept_clear || below.is_kept)
    return "I am to put nothing on " + below.words + ". Tell me that I may touch it again.";
  return std::nullopt;
}

} // namespace castor::planning
