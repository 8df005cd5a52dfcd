#pragma once

#include <string>
#include <string_view>

namespace castor::planning {

/// Why something was not done, for people: what a planner says of its search, and what things and
/// places are called inside, says nothing to them.
/// @param why of a planner, or any other clause, which stays as it is
inline std::string failure_in_words(std::string_view why) {
  if (why.starts_with("there is no plan"))
    return "as things are now, nothing that I can do leads to that";
  if (why.starts_with("no plan was found"))
    return "I did not find out in time how to do it";
  // "It failed 3 times, the last time because 'move robot object/7:k place-6' failed: it slipped".
  constexpr std::string_view last = "the last time because ";
  if (const auto at = why.find(last); at != std::string_view::npos)
    return failure_in_words(why.substr(at + last.size()));
  constexpr std::string_view failed = "' failed: ";
  if (const auto at = why.find(failed); why.starts_with('\'') && at != std::string_view::npos)
    return failure_in_words(why.substr(at + failed.size()));
  if (why.starts_with("all steps were done") || why.starts_with("the goal does not hold"))
    return "I have done all that it takes, but it is not so";
  const auto says = [why](std::string_view words) {
    return why.find(words) != std::string_view::npos;
  };
  if (says("would not reach the goal any more") || says("' is not possible any more") ||
      says("' waits for is known") || why == "the goal has changed")
    return "things have changed meanwhile";
  // "Move robot vision/object/7:k place-6".
  if (says("object/") || says("place-") || says("cannot be understood: "))
    return "something has gone wrong that I cannot put into words";
  return std::string{why};
}

} // namespace castor::planning
