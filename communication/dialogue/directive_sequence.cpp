#include "castor/communication/dialogue/directive_sequence.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace castor::communication {

namespace {

using Steps = std::vector<DirectiveStep>;

/// Whether a step is what the verb asks for.
bool does(const DirectiveStep& step, const std::string& verb, const Vocabulary& vocabulary) {
  const auto& actions = vocabulary.meanings().actions;
  const auto known = actions.find(verb);
  return known != actions.end() && step.action == known->second;
}

/// "Put the cube under the ball": the ball on the cube.
void put_others_on(Steps& steps) {
  for (auto& step : steps) {
    const bool is_under = step.places.size() == 1 && step.places.front().relation == "under" &&
                          step.places.front().landmarks.size() == 1 && step.things.size() == 1;
    if (!is_under || step.number != 0)
      continue;
    step.places.front().relation = "on";
    std::swap(step.things, step.places.front().landmarks);
  }
}

/// "Push the ball towards the cube without touching it": what is to be moved is not what is not
/// to be touched.
void keep_others_only(Steps& steps, const LogicalForm& request, const Vocabulary& vocabulary) {
  const bool is_meanwhile = std::ranges::any_of(
    request.nominals, [](const Nominal& x) { return feature(x, "Meanwhile") == "true"; });
  if (!is_meanwhile || steps.size() != 2 || !does(steps.back(), "forbid", vocabulary) ||
      steps.back().things != steps.front().things)
    return;
  if (const auto& places = steps.front().places;
      !places.empty() && !places.front().landmarks.empty())
    steps.back().things = places.front().landmarks;
  else
    steps.pop_back();
}

/// "The ball where the cube is, and the cube where the ball is": they change places.
void exchange(Steps& steps, const Vocabulary& vocabulary) {
  if (steps.size() != 2)
    return;
  const auto goes_where = [](const DirectiveStep& x, const DirectiveStep& other) {
    return x.things.size() == 1 && x.places.size() == 1 && x.places.front().relation == "where" &&
           x.places.front().landmarks == other.things;
  };
  const auto& first = steps.front();
  const auto& actions = vocabulary.meanings().actions;
  const auto swap = actions.find("swap");
  if (swap != actions.end() && goes_where(first, steps.back()) && goes_where(steps.back(), first))
    steps = {
      DirectiveStep{swap->second, {first.things.front(), steps.back().things.front()}, 0, {}, {}}};
}

/// "The cylinder in the middle, and the cube where the cylinder is now": where that was before.
void use_earlier_places(Steps& steps) {
  for (auto step = steps.begin(); step != steps.end(); ++step)
    for (auto& place : step->places)
      if (place.relation == "where" &&
          std::any_of(steps.begin(), step, [&](const DirectiveStep& before) {
            return !before.places.empty() && before.things == place.landmarks;
          }))
        place.relation = "where-before";
}

/// "Clear the right side and put the cylinder there": where the step before is done.
void resolve_there(Steps& steps) {
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (auto& places = steps[i].places;
        places.size() == 1 && places.front().relation == "there" && !steps[i - 1].places.empty())
      places = steps[i - 1].places;
}

/// "Sort them by shape: the balls on the left and the cubes on the right": where they go is said.
void drop_sorting_that_is_told(Steps& steps, const Vocabulary& vocabulary) {
  if (steps.size() < 3 || !does(steps.front(), "sort", vocabulary))
    return;
  const auto& sorted = steps.front().things;
  const bool is_told = std::all_of(steps.begin() + 1, steps.end(), [&](const auto& x) {
    return !x.places.empty() && std::ranges::all_of(x.things, [&](const auto& thing) {
      return std::ranges::find(sorted, thing) != sorted.end();
    });
  });
  if (is_told)
    steps.erase(steps.begin());
}

/// "Lift the ball and hold it there"; "take the balls and put them on the left", of which only
/// one at a time can be held.
void drop_needless(Steps& steps, const Vocabulary& vocabulary) {
  for (std::size_t i = 0; i + 1 < steps.size();) {
    const auto& x = steps[i];
    const auto& next = steps[i + 1];
    const bool is_said_again = x == next;
    // "Put it down and let go of it", "take it back and put it where it was".
    const bool is_done_once =
      does(x, "drop", vocabulary) || (does(x, "put-back", vocabulary) && !x.things.empty());
    if (is_said_again && is_done_once) {
      steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i));
      continue;
    }
    const bool are_put_anyway =
      x.things.size() > 1 && x.number == 0 && x.things == next.things && next.number == 0;
    if (does(x, "take", vocabulary) && (is_said_again || are_put_anyway))
      steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
}

} // namespace

std::vector<DirectiveStep> taken_together(std::vector<DirectiveStep> steps,
                                          const LogicalForm& request,
                                          const Vocabulary& vocabulary) {
  exchange(steps, vocabulary);
  put_others_on(steps);
  use_earlier_places(steps);
  resolve_there(steps);
  keep_others_only(steps, request, vocabulary);
  drop_sorting_that_is_told(steps, vocabulary);
  drop_needless(steps, vocabulary);
  return steps;
}

} // namespace castor::communication
