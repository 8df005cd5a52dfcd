#include "castor/planning/motivation/table_goal_maker.hpp"
#include "castor/planning/motivation/table_history.hpp"
#include "castor/planning/motivation/table_spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

/// What the robot says of the table where nothing is to be done.
namespace castor::planning {

namespace {

TableGoal answer(std::string words) {
  return {TableWish::answer, {}, {}, 0, std::move(words)};
}

std::string centimetres(double metres) {
  const auto number = std::lround(100 * metres);
  return number == 1 ? "1 centimetre" : std::to_string(number) + " centimetres";
}

double distance(const TableThing& a, const TableThing& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// An order in which things can be listed.
struct ListOrder {
  std::string_view action;
  std::string_view words;
  /// The least comes first.
  double (*key)(const TableThing& x);
};

constexpr std::array<ListOrder, 8> list_orders{
  {{"ListFromLeft", "From left to right", [](const TableThing& x) { return x.x; }},
   {"ListFromRight", "From right to left", [](const TableThing& x) { return -x.x; }},
   {"ListFromFront", "From front to back", [](const TableThing& x) { return x.y; }},
   {"ListFromBack", "From back to front", [](const TableThing& x) { return -x.y; }},
   {"ListFromSmallest", "From small to large",
    [](const TableThing& x) { return x.width() * x.width() * x.height; }},
   {"ListFromLargest", "From large to small",
    [](const TableThing& x) { return -x.width() * x.width() * x.height; }},
   {"ListFromLowest", "From low to high", [](const TableThing& x) { return x.height; }},
   {"ListFromHighest", "From high to low", [](const TableThing& x) { return -x.height; }}}};

const ListOrder* list_order(std::string_view action) {
  const auto found = std::ranges::find(list_orders, action, &ListOrder::action);
  return found == list_orders.end() ? nullptr : &*found;
}

} // namespace

bool is_question(std::string_view action) {
  constexpr std::array<std::string_view, 12> questions{
    "Displaced",   "Touching", "WhereWas", "WhatKept",  "MayTouch",    "HowFar",
    "HowFarMoved", "HowTall",  "HowWide",  "HaveMoved", "ClosestPair", "FarthestPair"};
  return std::ranges::find(questions, action) != questions.end() || list_order(action) != nullptr ||
         asks_about_history(action);
}

TableGoal TableGoalMaker::answer_question() const {
  const auto& action = step_.action;
  if (action == "WhereWas")
    return where_was();
  if (action == "HaveMoved")
    return have_moved();
  if (action == "HowFarMoved")
    return how_far_moved();
  if (action == "WhatKept")
    return what_is_kept();
  if (action == "MayTouch")
    return may_touch();
  if (action == "HowFar")
    return how_far();
  if (action == "ClosestPair" || action == "FarthestPair")
    return extreme_pair(action == "ClosestPair");
  if (list_order(action) != nullptr)
    return list_in_order();
  if (action == "Displaced")
    return displaced();
  if (action == "Touching")
    return touching();
  return how_large(action == "HowTall");
}

/// "Is everything where it was at the beginning? And the cube?"
TableGoal TableGoalMaker::displaced() const {
  Things moved;
  for (const auto& x : table_)
    if (x.was_moved() && (x.is_held || x.waypoint != x.waypoint_at_first) &&
        (things_.empty() || std::ranges::find(things_, &x) != things_.end()))
      moved.push_back(&x);
  const auto place_of = [](const Things& x) {
    return std::string{x.size() == 1 ? " where it was at first" : " where they were at first"};
  };
  if (moved.empty() && things_.empty())
    return answer("Everything is where it was at first.");
  if (moved.empty())
    return answer("Yes, " + listed(things_) + are(things_) + place_of(things_) + '.');
  const auto not_there = listed(moved) + are(moved) + " not" + place_of(moved);
  return answer(things_.empty() ? sentence(not_there) : "No, " + not_there + '.');
}

TableGoal TableGoalMaker::touching() const {
  if (things_.size() != 2)
    return refusal("I can say whether two things touch each other: tell me which two.");
  const auto& a = *things_.front();
  const auto& b = *things_.back();
  if (a.is_held || b.is_held)
    return answer("No, I hold " + (a.is_held ? a : b).words + " now.");
  if (a.on == b.object || b.on == a.object)
    return answer("Yes: " + (a.on == b.object ? a : b).words + " stands on the other.");
  const double gap = distance(a, b) - (a.width() + b.width()) / 2;
  // Vision does not see more exactly than that.
  constexpr double exactness = 0.006;
  return answer(gap < exactness
                  ? "Yes, or nearly: I see no gap between them."
                  : "No: there are about " + fine_centimetres(gap) + " between them.");
}

TableGoal TableGoalMaker::list_in_order() const {
  const auto& order = *list_order(step_.action);
  auto listed_things = things_;
  std::erase_if(listed_things, [](const auto* x) { return x->is_held; });
  std::ranges::stable_sort(listed_things, {}, [&](const auto* x) { return order.key(*x); });
  return answer(listed_things.empty()
                  ? "There is nothing to list."
                  : std::string{order.words} + ": " + listed(listed_things) + '.');
}

TableGoal TableGoalMaker::have_moved() const {
  Things moved;
  Things others;
  for (const auto* x : things_)
    (x->was_moved() ? moved : others).push_back(x);
  if (moved.empty())
    return answer("No, I have not moved " + listed(others) + '.');
  return answer("Yes, I have moved " + listed(moved) +
                (others.empty() ? "" : ", but not " + listed(others)) + '.');
}

/// "How far did the ball go?" Of several that it may be, those that were moved.
TableGoalMaker::Things TableGoalMaker::those_moved() const {
  auto result = things_;
  if (step_.number > 0)
    std::erase_if(result, [](const auto* x) { return !x->was_moved(); });
  return result;
}

TableGoal TableGoalMaker::how_far_moved() const {
  std::string result;
  for (const auto* x : those_moved()) {
    if (!result.empty())
      result += ' ';
    if (!x->was_moved() || x->spot_before.name.empty())
      result += sentence("I have not moved " + x->words);
    else if (x->is_held)
      result += sentence("I hold " + x->words + " now");
    else
      result += sentence("I have moved " + x->words + " by about " +
                         centimetres(std::hypot(x->x - x->spot_before.x, x->y - x->spot_before.y)));
  }
  return answer(result.empty() ? "I have moved none of them." : result);
}

TableGoal TableGoalMaker::what_is_kept() const {
  Things kept;
  Things clear;
  for (const auto& x : table_)
    if (x.is_kept)
      kept.push_back(&x);
    else if (x.is_kept_clear)
      clear.push_back(&x);
  std::string result;
  if (!kept.empty())
    result = "I am not to touch " + listed(kept) + '.';
  if (!clear.empty())
    result += (result.empty() ? "" : " ") + ("I am to put nothing on " + listed(clear) + '.');
  return answer(result.empty() ? "Nothing is forbidden: I may touch everything." : result);
}

TableGoal TableGoalMaker::may_touch() const {
  Things kept;
  for (const auto* x : things_)
    if (x->is_kept)
      kept.push_back(x);
  return answer(kept.empty() ? "Yes, I may touch " + listed(things_) + '.'
                             : "No, I was told not to touch " + listed(kept) + '.');
}

TableGoal TableGoalMaker::how_far() const {
  if (things_.size() != 2)
    return refusal("I can say how far two things are from each other: tell me which two.");
  const auto& a = *things_.front();
  const auto& b = *things_.back();
  if (a.is_held || b.is_held)
    return answer("I hold " + (a.is_held ? a : b).words + " now.");
  return answer("About " + centimetres(distance(a, b)) + " from middle to middle.");
}

TableGoal TableGoalMaker::extreme_pair(bool is_closest) const {
  const TableThing* first = nullptr;
  const TableThing* second = nullptr;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < things_.size(); ++i)
    for (std::size_t j = i + 1; j < things_.size(); ++j) {
      const auto& a = *things_[i];
      const auto& b = *things_[j];
      const double key = (is_closest ? 1 : -1) * distance(a, b);
      if (!a.is_held && !b.is_held && key < best) {
        best = key;
        first = &a;
        second = &b;
      }
    }
  if (first == nullptr)
    return refusal("That takes two things at least.");
  auto result = answer(sentence(first->words + " and " + second->words + ": they are about " +
                                centimetres(std::abs(best)) + " apart"));
  result.things = {first->proxy, second->proxy};
  return result;
}

/// "How high is the tower?": from the table to its top.
TableGoal TableGoalMaker::height_of_tower() const {
  double height = 0;
  for (const auto* x : things_) {
    if (x->height <= 0)
      return answer("I do not know how high " + x->words + " is.");
    height += x->height;
  }
  return answer("It is about " + fine_centimetres(height) + " high: " + listed(things_) + '.');
}

/// "How wide is the cylinder compared with the cube?"
TableGoal TableGoalMaker::how_large(bool is_height) const {
  if (is_height && step_.by == communication::as_tower)
    return height_of_tower();
  std::string result;
  std::vector<double> sizes;
  for (const auto* x : things_) {
    const double size = is_height ? x->height : x->width();
    if (size <= 0)
      return answer("I do not know how large " + x->words + " is.");
    sizes.push_back(size);
    result += (result.empty() ? "" : ", ") + x->words + " is about " + fine_centimetres(size) +
              (is_height ? " high" : " wide");
  }
  // A cube is as high as it is wide.
  constexpr double clearly_different = 0.015;
  if (!is_height && things_.size() == 1)
    if (const double height = things_.front()->height;
        height > 0 && std::abs(height - sizes.front()) > clearly_different)
      result += " and " + fine_centimetres(height) + " high";
  constexpr double same = 0.004;
  if (sizes.size() == 2)
    result += std::abs(sizes[0] - sizes[1]) < same ? ": that is about the same"
              : sizes[0] > sizes[1] ? std::string{": it is "} + (is_height ? "higher" : "wider")
                                    : std::string{": it is "} + (is_height ? "lower" : "narrower");
  return answer(result.empty() ? "I do not know." : sentence(result));
}

} // namespace castor::planning
