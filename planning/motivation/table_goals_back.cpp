#include "castor/planning/motivation/table_goal_maker.hpp"
#include "castor/planning/motivation/table_places.hpp"

#include <algorithm>
#include <utility>

/// Goals that are about where things were before.
namespace castor::planning {

TableGoal TableGoalMaker::put_back() {
  // Of those that may be meant, the one that was moved.
  if (step_.number > 0) {
    const auto moved =
      std::ranges::find_if(things_, [](const auto* x) { return !x->waypoint_before.empty(); });
    if (moved == things_.end())
      return refusal("There is nothing to put back.");
    things_ = {*moved};
  }
  // "In its old place", where "it" may be another thing: that of this one, if it has one.
  if (things_.size() == 1 && !things_.front()->was_moved() && has_landmark_that_was_moved())
    return put();
  // "Both": those that were moved.
  if (std::ranges::any_of(things_, &TableThing::was_moved))
    std::erase_if(things_, [](const auto* x) { return !x->was_moved(); });
  for (const auto* x : things_) {
    if (x->waypoint_before.empty())
      return refusal("I have not moved " + x->words + ": it is where I saw it first.");
    facts_.push_back(at_waypoint(*x, waypoint_to_return_to(*x)));
  }
  return return_goal("", "where " + it_was() + " before");
}

std::string TableGoalMaker::waypoint_to_return_to(const TableThing& x) {
  // It is back already, not to be brought where it was wrong.
  if (x.has_returned)
    return x.waypoint;
  // It may have stood somewhere else on its way.
  return x.waypoint_before_goal.empty() ? x.waypoint_before : x.waypoint_before_goal;
}

/// "Put it back `words`", and then it is `result`.
TableGoal TableGoalMaker::return_goal(const std::string& words, const std::string& result) {
  auto it = goal(done_before_taking() + "put " + listed(things_) + " back" + words,
                 listed(things_) + are(things_) + ' ' + result);
  it.is_return = true;
  return it;
}

bool TableGoalMaker::has_landmark_that_was_moved() const {
  if (step_.places.empty() || step_.places.front().landmarks.size() != 1)
    return false;
  const auto* x = thing(step_.places.front().landmarks.front());
  return x != nullptr && x->was_moved();
}

TableGoal TableGoalMaker::undo() {
  for (const auto& x : table_)
    if (!x.waypoint_before_goal.empty() && !x.is_kept)
      back_to(x, x.waypoint_before_goal);
  if (things_.empty())
    return refusal("There is nothing to undo.");
  return return_goal("", "where " + it_was() + " before");
}

/// Those that were moved, or all, are where they were before anything was done.
TableGoal TableGoalMaker::restore() {
  const auto asked = std::exchange(things_, {});
  for (const auto& x : table_) {
    const bool is_asked = asked.empty() || std::ranges::find(asked, &x) != asked.end();
    if (is_asked && !x.is_kept && x.was_moved() && (x.is_held || x.waypoint != x.waypoint_at_first))
      back_to(x, x.waypoint_at_first);
  }
  if (things_.empty())
    return refusal("I have moved nothing that is not where it was at first.");
  const auto where = "where " + it_was() + " at first";
  return return_goal(' ' + where, where);
}

/// As they were when people said to remember that.
TableGoal TableGoalMaker::put_as_noted() {
  if (std::ranges::all_of(table_, [](const auto& x) { return x.waypoint_noted.empty(); }))
    return refusal("I was not told to remember how things were. Say 'remember this' for that.");
  things_.clear();
  for (const auto& x : table_)
    if (!x.is_kept && !x.waypoint_noted.empty() && (x.is_held || x.waypoint != x.waypoint_noted))
      back_to(x, x.waypoint_noted);
  if (things_.empty())
    return refusal("Everything is as I was to remember it.");
  return return_goal(" where " + it_was(), "as I was to remember");
}

void TableGoalMaker::back_to(const TableThing& x, const std::string& waypoint) {
  things_.push_back(&x);
  facts_.push_back(at_waypoint(x, waypoint));
}

std::string TableGoalMaker::it_was() const {
  return things_.size() == 1 ? "it was" : "they were";
}

TableGoal TableGoalMaker::where_was() const {
  std::string result;
  for (const auto* x : those_moved())
    result +=
      (result.empty() ? "" : " ") +
      (x->was_moved() ? sentence(x->words + " was " + place_in_words(x->spot_before, *x, table_))
                      : sentence("I have not moved " + x->words));
  if (result.empty())
    result = "I have moved none of them.";
  return {TableWish::answer, {}, {}, 0, std::move(result)};
}

} // namespace castor::planning
