#pragma once

#include "castor/communication/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <string>

/// Entry types of requests about things on a table.
namespace castor::planning {

/// A call: what is to be reached so that a step of a request is done? Replied to by a
/// TableGoalReply.
struct TableGoalRequest {
  communication::DirectiveStep step;
  /// The goal is pursued from now on; else it is only asked whether there is one.
  bool begins = true;
};

struct TableGoalReply {
  /// A sentence that says why there is no goal; empty if there is one.
  std::string refusal;
  AchieveGoal goal;
  /// What is to be done, as an infinitive.
  std::string words;
  /// A sentence for when it is so.
  std::string result;
};

/// Entry: why a step of the goal that is pursued has failed last. Its id is `table_problem`.
struct TableProblem {
  /// A clause; empty if none has failed.
  std::string reason;
};

inline constexpr const char* table_problem = "table problem";

CASTOR_REFLECT(TableProblem, reason)
CASTOR_REFLECT(TableGoalRequest, step, begins)
CASTOR_REFLECT(TableGoalReply, refusal, goal, words, result)

} // namespace castor::planning
