#include "castor/planning/manipulation/blocked_way.hpp"

#include <algorithm>

namespace castor::manipulation {

namespace {

std::vector<std::string> obstacles_of(const std::vector<Contact>& contacts) {
  std::vector<std::string> result;
  for (const auto& x : contacts)
    if (!x.is_of_arm && std::ranges::count(result, x.other) == 0)
      result.push_back(x.other);
  return result;
}

/// As few things as possible that there is a way without, if there is one without all of them.
std::vector<std::string> fewest(const std::vector<std::string>& things,
                                const WayWithout& has_way_without) {
  auto result = things;
  for (const auto& thing : things) {
    auto others = result;
    std::erase(others, thing);
    if (has_way_without(others))
      result = others;
  }
  return result;
}

} // namespace

std::string listed(const std::vector<std::string>& names, const std::string& conjunction) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 == names.size() ? " " + conjunction + " " : ", ") + names[i];
  return result;
}

MotionFailure blocked_start(const Contact& contact) {
  MotionFailure result{MotionFailureKind::start_blocked, obstacles_of({contact}), {}};
  result.text = "the arm cannot move: " + contact.part + " touches " + contact.other +
                " already; move one of them by hand";
  return result;
}

MotionFailure blocked_goal(const std::vector<Contact>& contacts, const std::string& destination) {
  MotionFailure result{MotionFailureKind::goal_blocked, obstacles_of(contacts), {}};
  if (result.obstacles.empty())
    result.text = "the arm would touch itself at " + destination;
  else
    result.text = listed(result.obstacles) + (result.obstacles.size() == 1 ? " is" : " are") +
                  " in the arm's way at " + destination;
  return result;
}

MotionFailure blocked_way(const std::vector<std::string>& things, const std::string& destination,
                          const WayWithout& has_way_without) {
  MotionFailure result;
  std::vector<std::string> each;
  for (const auto& thing : things)
    if (has_way_without({thing}))
      each.push_back(thing);
  if (each.size() == 1) {
    result.obstacles = each;
    result.text = each.front() + " blocks every way to " + destination;
  } else if (each.size() > 1) {
    result.obstacles = each;
    result.text =
      "there is no way to " + destination + ": it would help to take away " + listed(each, "or");
  } else if (things.size() > 1 && has_way_without(things)) {
    result.obstacles = fewest(things, has_way_without);
    result.text = listed(result.obstacles) + " together block every way to " + destination;
  } else {
    result.text = "no way to " + destination + " was found, even without what is in between";
  }
  return result;
}

} // namespace castor::manipulation
