#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace castor::planning {

/// Why something could not be done in one way of several.
struct Refusal {
  /// A clause: "the box is in the arm's way at the ball".
  std::string reason;
  /// Names of things that are in the way.
  std::vector<std::string> in_way = {};
  /// Ids of their SceneObjects, in the same order; empty if they are not known.
  std::vector<std::string> in_way_ids = {};
};

/// Why it could not be done at all, and what would help.
struct Explanation {
  /// A clause; empty if nothing was refused.
  std::string reason;
  /// A sentence: "Take the box away first."; empty if nothing is known that would.
  std::string help;
  /// Ids of the things that help if they are taken away.
  std::vector<std::string> in_way_ids = {};

  friend bool operator==(const Explanation&, const Explanation&) = default;
};

/// What explains most of the refusals: the thing that is in the way most often, if it is so in at
/// least half of them, otherwise the most frequent reason. Of equals, the first. Where nothing is
/// in the way, another place may help, or to push what cannot be grasped.
Explanation explanation_of(const std::vector<Refusal>& refusals);

/// The reason, with the joints of the arm that do not move any more, if it does not name them.
std::string with_joints(std::string reason, const std::vector<std::string>& joints);

/// Why a planner has none, for people: what it says of its search is none of their business.
/// @param reason of the planner, or any other, which stays as it is
Explanation explanation_of_planning(std::string_view reason);

/// The text, with other words in place of some.
/// @param words "ball" for "sphere"
std::string with_words(std::string_view text, const std::map<std::string, std::string>& words);

} // namespace castor::planning
