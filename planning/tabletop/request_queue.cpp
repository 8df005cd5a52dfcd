#include "castor/planning/tabletop/request_queue.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace castor::planning {

namespace {

using communication::DirectiveStep;

/// Whether it only moves the things that it names.
bool moves_named_things(const DirectiveStep& x) {
  return !x.things.empty() &&
         (x.action == "Put" || x.action == "Take" || x.action == "Give" || x.action == "Push");
}

bool puts_back(const DirectiveStep& x) {
  return (x.action == "PutBack" && x.places.empty()) || x.action == "Undo";
}

/// "It was better before. Put it back.": the second asks for what the first does.
bool is_said_again(const DirectiveStep& x, const DirectiveStep& before) {
  return puts_back(x) && puts_back(before) &&
         (x.things.empty() || before.things.empty() || x.things == before.things);
}

/// Its things, and those that its places are told by.
std::vector<std::string> mentioned_in(const DirectiveStep& x) {
  auto result = x.things;
  for (const auto& place : x.places)
    result.insert(result.end(), place.landmarks.begin(), place.landmarks.end());
  return result;
}

/// "Put the ball on the left, and the cube next to it": unless each of the two is only about things
/// that the other does not mention.
bool depends_on(const DirectiveStep& x, const DirectiveStep& before) {
  if (!moves_named_things(x) || !moves_named_things(before))
    return true;
  const auto mentioned = mentioned_in(x);
  const auto mentioned_before = mentioned_in(before);
  return std::ranges::any_of(mentioned, [&](const auto& id) {
    return std::ranges::find(mentioned_before, id) != mentioned_before.end();
  });
}

} // namespace

void RequestQueue::recall(RequestedSteps x, bool is_motive_there) {
  steps_ = std::move(x);
  if (is_busy() && !is_motive_there) {
    steps_.waiting.insert(steps_.waiting.begin(), steps_.current);
    steps_.motive = {};
  }
}

bool RequestQueue::has_steps_of(const Address& move) const {
  return (is_busy() && steps_.current.move.address == move) ||
         std::ranges::any_of(steps_.waiting,
                             [&](const RequestedStep& x) { return x.move.address == move; });
}

void RequestQueue::drop_steps_of(const Address& move) {
  std::erase_if(steps_.waiting, [&](const RequestedStep& x) { return x.move.address == move; });
}

/// The last request is not wanted any more. \returns its motive, if it is done now
Address RequestQueue::drop_last() {
  if (steps_.waiting.empty())
    return std::exchange(steps_.motive, {});
  const auto last = steps_.waiting.back().move.address;
  drop_steps_of(last);
  return is_busy() && steps_.current.move.address == last ? std::exchange(steps_.motive, {})
                                                          : Address{};
}

/// Whether the last step, which is done, took another thing, or put another one there.
bool RequestQueue::moved_other_than(const RequestedStep& step) const {
  const auto& last = steps_.current.what;
  const bool is_same_deed = last.action == step.what.action && last.places == step.what.places;
  const bool is_undone = last.action == "Take" ||
                         (last.action == "Swap" && last.things.size() == 2) ||
                         (last.action == "Put" && !last.places.empty() && last.things.size() == 1 &&
                          step.what.things.size() == 1);
  return !is_busy() && !steps_.was_so && steps_.waiting.empty() && steps_.given_up.empty() &&
         is_same_deed && is_undone && last.number == 0 && step.what.things != last.things;
}

/// "Wrong, the red cube": what was moved is put back where it was, what was swapped is swapped
/// again.
RequestedStep RequestQueue::put_back_before(const RequestedStep& step) const {
  RequestedStep back{step.move, {}, step.agrees_to};
  back.what.action = steps_.current.what.action == "Swap" ? "Swap" : "PutBack";
  back.what.things = steps_.current.what.things;
  return back;
}

/// "Clear the left side. I need some room there": where the step before is done.
void RequestQueue::resolve_there(RequestedStep& step) const {
  const auto& before = steps_.waiting.empty() ? steps_.current : steps_.waiting.back();
  auto& places = step.what.places;
  if (places.size() == 1 && places.front().relation == "there" &&
      places.front().landmarks.empty() && !before.what.places.empty())
    places = before.what.places;
}

Address RequestQueue::add(std::vector<RequestedStep> steps,
                          const communication::MoveReferents& said) {
  auto& waiting = steps_.waiting;
  std::erase_if(steps, [&](const RequestedStep& x) {
    return (is_busy() && is_said_again(x.what, steps_.current.what)) ||
           std::ranges::any_of(waiting, [&](const RequestedStep& before) {
             return is_said_again(x.what, before.what);
           });
  });
  if (!steps.empty())
    resolve_there(steps.front());
  Address unwanted;
  std::optional<RequestedStep> back;
  if (said.corrects && !steps.empty() && moved_other_than(steps.front()))
    back = put_back_before(steps.front());
  else if (said.corrects)
    unwanted = drop_last();
  if (back)
    waiting.push_back(*back);
  if (!said.comes_first) {
    // "I meant the cube. Put the ball back": the correction does that.
    std::ranges::copy_if(steps, std::back_inserter(waiting), [&](const RequestedStep& x) {
      return !back || x.what.action != back->what.action || x.what.things != back->what.things;
    });
    return unwanted;
  }
  if (is_busy()) {
    unwanted = std::exchange(steps_.motive, {});
    waiting.insert(waiting.begin(), steps_.current);
  } else if (waiting.empty()) {
    waiting = std::exchange(steps_.given_up, {});
  }
  waiting.insert(waiting.begin(), steps.begin(), steps.end());
  return unwanted;
}

Address RequestQueue::stop() {
  auto motive = std::exchange(steps_.motive, {});
  std::vector<RequestedStep> stopped;
  if (!motive.id.empty())
    stopped.push_back(steps_.current);
  stopped.insert(stopped.end(), steps_.waiting.begin(), steps_.waiting.end());
  // "Stop! Stop!"
  if (stopped.empty())
    stopped = std::move(steps_.stopped);
  steps_ = {};
  steps_.stopped = std::move(stopped);
  return motive;
}

bool RequestQueue::go_on() {
  if (!is_busy() && steps_.waiting.empty())
    steps_.waiting = std::exchange(steps_.stopped, {});
  return is_busy() || !steps_.waiting.empty();
}

const RequestedStep* RequestQueue::next() {
  if (is_busy() || steps_.is_paused || steps_.waiting.empty())
    return nullptr;
  steps_.current = std::move(steps_.waiting.front());
  steps_.waiting.erase(steps_.waiting.begin());
  return &steps_.current;
}

void RequestQueue::begin(const Address& motive, std::string result,
                         std::vector<std::string> chosen) {
  steps_.motive = motive;
  steps_.result = std::move(result);
  steps_.chosen = std::move(chosen);
  steps_.was_so = false;
  steps_.given_up.clear();
  steps_.stopped.clear();
}

void RequestQueue::done(bool was_so) {
  steps_.motive = {};
  steps_.was_so = was_so;
}

bool RequestQueue::try_again(bool has_begun) {
  auto again = steps_.current;
  auto& things = again.what.things;
  if (again.what.number > 0) {
    const auto tried = std::erase_if(things, [&](const std::string& x) {
      return std::ranges::find(steps_.chosen, x) != steps_.chosen.end();
    });
    if (tried == 0 || things.size() < static_cast<std::size_t>(again.what.number))
      return false;
  } else if (!has_begun || again.was_begun || again.what.action != "Put" || things.size() < 2)
    return false;
  again.was_begun = true;
  steps_.motive = {};
  steps_.waiting.insert(steps_.waiting.begin(), std::move(again));
  return true;
}

bool RequestQueue::give_up(bool undoes) {
  const auto failed = steps_.current;
  steps_.motive = {};
  steps_.given_up = {failed};
  std::erase_if(steps_.waiting, [&](const RequestedStep& x) {
    const bool is_dropped = x.move.address == failed.move.address &&
                            std::ranges::any_of(steps_.given_up, [&](const RequestedStep& before) {
                              return depends_on(x.what, before.what);
                            });
    if (is_dropped)
      steps_.given_up.push_back(x);
    return is_dropped;
  });
  const bool has_dropped = steps_.given_up.size() > 1;
  if (!undoes)
    return has_dropped;
  RequestedStep undo{failed.move, {}, failed.agrees_to};
  undo.what.action = "Undo";
  steps_.waiting.insert(steps_.waiting.begin(), std::move(undo));
  return has_dropped;
}

std::vector<RequestedStep> without_needless_moves(std::vector<RequestedStep> steps) {
  std::vector<RequestedStep> result;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto& places = steps[i].what.places;
    const bool is_vague =
      places.size() == 1 && (places[0].relation == "elsewhere" || places[0].relation == "aside");
    const auto* next = i + 1 < steps.size() ? &steps[i + 1].what : nullptr;
    const bool is_taken_next = next != nullptr && next->places.empty() &&
                               (next->action == "Give" || next->action == "Take") &&
                               next->things == steps[i].what.things &&
                               next->number == steps[i].what.number;
    const bool is_put_next = steps[i].what.action == "Take" && places.empty() && next != nullptr &&
                             next->action == "Put" && next->things == steps[i].what.things &&
                             next->number == steps[i].what.number;
    if (!(is_vague && is_taken_next) && !is_put_next)
      result.push_back(std::move(steps[i]));
  }
  return result;
}

} // namespace castor::planning
