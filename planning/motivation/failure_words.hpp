#pragma once

#include <string>
#include <string_view>

namespace castor::planning {

/// Why something was not done, for people: what a planner says of its search says nothing to them.
/// @param why of a planner, or any other clause, which stays as it is
inline std::string failure_in_words(std::string_view why) {
  if (why.starts_with("there is no plan"))
    return "as things are now, nothing that I can do leads to that";
  if (why.starts_with("no plan was found"))
    return "I did not find out in time how to do it";
  return std::string{why};
}

} // namespace castor::planning
