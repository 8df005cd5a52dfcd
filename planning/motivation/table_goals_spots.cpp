#include "castor/planning/motivation/table_arrangements.hpp"
#include "castor/planning/motivation/table_goal_maker.hpp"
#include "castor/planning/motivation/table_spots.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

/// Goals with places that are measured, or chosen by what stands where.
namespace castor::planning {

namespace {

constexpr std::pair<std::string_view, std::string_view> measured_words[] = {
  {"midway", "half-way between"},
  {"equidistant", "as far from"},
  {"in-line", "in line with"},
  {"level", "level with"},
  {"level-across", "in the same column as"},
  {"centre", "towards the middle"},
  {"left-edge", "from the left edge"},
  {"right-edge", "from the right edge"},
  {"front-edge", "from the front edge"},
  {"back-edge", "from the back edge"},
  {"edge", "from the edge"},
  {"other-side", "on the other side of"},
  {"roomiest", "where there is room"},
  {"closer", "closer to"},
  {"farther", "farther from"},
  {"left", "to the left of"},
  {"right", "to the right of"},
  {"front", "in front of"},
  {"back", "behind"},
  {"near", "away from"}};

} // namespace

/// \returns why it is impossible
std::optional<std::string> TableGoalMaker::put_at_spot(const DirectivePlace& place,
                                                       std::string& where) {
  if (things_.size() != 1)
    return "There is room for one thing only.";
  const auto& x = *things_.front();
  Things landmarks;
  for (const auto& proxy : place.landmarks) {
    landmarks.push_back(thing(proxy));
    if (landmarks.back() == nullptr)
      return "I do not see all of that any more.";
    if (landmarks.back() == &x)
      return "I cannot put " + x.words + " by itself.";
    if (landmarks.back()->is_held)
      return "I hold " + landmarks.back()->words + ". Tell me to put it down first.";
  }
  if (!takes_landmarks(place.relation, landmarks.size()))
    return landmarks_needed(place.relation) == 2
             ? "That takes two things, but I know of " + std::to_string(landmarks.size()) + '.'
             : "That can be said of one thing only.";
  const bool is_seen_from_there =
    place.relation == "other-side" || place.relation == "closer" || place.relation == "farther";
  if (is_seen_from_there && x.is_held)
    return "I hold " + x.words + ": tell me where to put it.";
  std::string words;
  if (place.distance > 0)
    words += ' ' + fine_centimetres(place.distance);
  words += ' ' + std::string{words_for(measured_words, place.relation)};
  if (!landmarks.empty())
    words += ' ' + listed(landmarks);
  if (place.relation == "equidistant")
    words = " as far from " + landmarks.front()->words + " as from " + landmarks.back()->words;
  auto spot = measured_spot(place.relation, place.distance, x, landmarks, room_);
  if (!spot)
    return "There is no room for " + x.words + words + ".";
  facts_.push_back(at_waypoint(x, spot->name));
  spots_.push_back(std::move(*spot));
  where += words;
  return std::nullopt;
}

/// "One ball on each side of the cube."
TableGoal TableGoalMaker::put_on_both_sides(const DirectivePlace& place) {
  Things middles;
  for (const auto& proxy : place.landmarks)
    if (const auto* x = thing(proxy))
      middles.push_back(x);
  // A stack has its sides where the lowest thing has them.
  middles = without_upper_ones(std::move(middles));
  const auto* middle = middles.size() == 1 ? middles.front() : nullptr;
  std::erase(things_, middle);
  if (middle == nullptr || things_.size() != 2)
    return refusal("I can put two things on both sides of one.");
  if (const auto held = std::ranges::find_if(things_, &TableThing::is_held); held != things_.end())
    return refusal("I hold " + (*held)->words + ". Tell me to put it down first.");
  spots_ = both_sides(things_, *middle, room_);
  const auto words = "on both sides of " + middle->words;
  if (spots_.empty())
    return refusal("There is no room for them " + words + '.');
  for (std::size_t i = 0; i < things_.size(); ++i)
    facts_.push_back(at_waypoint(*things_[i], spots_[i].name));
  return goal("put " + listed(things_) + ' ' + words, listed(things_) + " are " + words + " now");
}

/// What nothing is on, and which is itself on something; null unless there is one such thing.
const TableThing* TableGoalMaker::top_of_stack() const {
  const TableThing* result = nullptr;
  for (const auto& x : table_) {
    const bool is_loaded = std::ranges::any_of(
      table_, [&](const TableThing& y) { return !y.is_held && y.on == x.object; });
    if (x.on.empty() || x.is_held || is_loaded)
      continue;
    if (result != nullptr)
      return nullptr;
    result = &x;
  }
  return result;
}

/// "On top": of what is stacked.
std::optional<std::string> TableGoalMaker::put_on_top(std::string& where) {
  const auto* top = top_of_stack();
  if (top == nullptr)
    return "I do not know on top of what: tell me on which thing to put it.";
  DirectivePlace place{"on", {top->proxy}};
  return put_at_landmarks(place, where);
}

/// In a row from left to right, by a measure of theirs: as large is what is as long.
TableGoal TableGoalMaker::sort_in_row() {
  constexpr std::string_view down = "-down";
  const bool is_down = step_.by.ends_with(down);
  const auto by = is_down ? step_.by.substr(0, step_.by.size() - down.size()) : step_.by;
  if (things_.size() < 2)
    return refusal("That takes two things at least.");
  if (std::ranges::any_of(things_, [](const auto* x) { return x->height <= 0; }))
    return refusal("I do not know how large all of them are.");
  std::ranges::stable_sort(things_, {}, [&](const TableThing* x) {
    const double measure = by == "height"  ? x->height
                           : by == "width" ? x->width()
                                           : std::max(x->height, x->width());
    return is_down ? -measure : measure;
  });
  const auto part = std::ranges::find_if(step_.places, [](const DirectivePlace& x) {
    return x.relation != "table" && !words_for(part_words, x.relation).empty();
  });
  auto result = arrange_at("in-row-as-named", part == step_.places.end() ? "" : part->relation);
  if (result.wish != TableWish::goal)
    return result;
  const auto measure = " by " + (by == "volume" ? std::string{"size"} : by);
  result.words = "sort " + listed(things_) + measure + but_what_is_kept();
  result.result = sentence(listed(things_) + " are in a row" + measure + " now");
  return result;
}

} // namespace castor::planning
