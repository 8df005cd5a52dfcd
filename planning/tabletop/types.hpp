#pragma once

#include "castor/communication/types.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Entry types of requests about things on a table.
namespace castor::planning {

/// A call: what is to be reached so that a step of a request is done? Replied to by a
/// TableGoalReply.
struct TableGoalRequest {
  communication::DirectiveStep step;
  /// The goal is pursued from now on; else it is only asked whether there is one.
  bool begins = true;
  /// Of the goal: "you said 'put the ball there'".
  std::string because = {};
};

struct TableGoalReply {
  /// A sentence that says why there is no goal, or answers what was asked; empty if there is one.
  std::string refusal;
  AchieveGoal goal;
  /// What is to be done, as an infinitive.
  std::string words;
  /// A sentence for when it is so.
  std::string result;
  /// Proxies of the things that it is about: of "one of the balls" the one that was chosen.
  std::vector<std::string> things = {};
  /// Whether the refusal says why there is no goal.
  bool is_impossible = false;
};

/// Entry: why a step of the goal that is pursued could not be done. Its id is `table_problem`.
struct TableProblem {
  /// A clause; empty if none has failed.
  std::string reason;
  /// What would help, a sentence; may be empty.
  std::string help;
  /// Whether steps before it were done.
  bool has_begun = false;
};

inline constexpr const char* table_problem = "table problem";

/// A colour, a shape or a size.
struct RememberedQuality {
  std::string kind;
  std::string value;

  friend bool operator==(const RememberedQuality&, const RememberedQuality&) = default;
};

/// A thing as it was seen last; metres, in the table's frame.
struct RememberedThing {
  std::string name;
  /// Of its SceneObject and of its proxy.
  std::string id;
  std::string proxy;
  std::vector<RememberedQuality> qualities;
  spatial::GroundPoint place;
  double radius = 0;
  double height = 0;
  std::string waypoint;
  std::string waypoint_before;
  bool is_held = false;
  /// Name of the thing that it stands on; empty for the table.
  std::string on;
  std::vector<std::string> former_proxies;
  std::string waypoint_before_goal;
  std::string waypoint_at_first;
  /// Not to be touched; nothing is to be put on it.
  bool is_kept = false;
  bool is_kept_clear = false;
  /// Where it was when people said to remember that.
  std::string waypoint_noted;
  /// As of ThingOnTable.
  geometry::Point3 lengths = {};
  /// It was last moved to put it where it was before.
  bool has_returned = false;

  friend bool operator==(const RememberedThing&, const RememberedThing&) = default;
};

struct RememberedWaypoint {
  std::string name;
  spatial::GroundPoint place;

  friend bool operator==(const RememberedWaypoint&, const RememberedWaypoint&) = default;
};

/// A waypoint that a plan has chosen, and where nothing is yet.
struct RememberedChoice {
  std::string waypoint;
  std::vector<spatial::WantedPlace> wanted;

  friend bool operator==(const RememberedChoice&, const RememberedChoice&) = default;
};

/// A move that was made: the planner's name of the thing, how it is called, and what it was done
/// for.
struct RememberedMove {
  std::string thing;
  std::string words;
  std::string because = {};

  friend bool operator==(const RememberedMove&, const RememberedMove&) = default;
};

/// Entry: what a TableExecutor knows of the table that is not to be seen, so that its successor
/// knows it too. Its id is `remembered_table`.
struct RememberedTable {
  std::vector<RememberedThing> things;
  std::vector<RememberedWaypoint> waypoints;
  std::vector<RememberedChoice> chosen;
  /// Facts of the goal that nobody sees.
  std::vector<std::string> done;
  std::uint64_t next_waypoint = 1;
  /// Number of moves that were made, and the last of them in their order.
  std::uint64_t moves = 0;
  std::vector<RememberedMove> last_moves = {};
  /// What the goal that has begun is done for.
  std::string because = {};

  friend bool operator==(const RememberedTable&, const RememberedTable&) = default;
};

inline constexpr const char* remembered_table = "remembered table";

/// The proxy by which requests refer to a thing that is remembered, but not seen.
/// @param name the planner's
inline std::string hidden_proxy(const std::string& name) {
  return "table/" + name;
}

/// A step of what somebody has asked for.
struct RequestedStep {
  EntryPointer<communication::DialogueMove> move;
  communication::DirectiveStep what;
  /// The utterance that asks for it, if the move only agrees to that.
  std::optional<EntryPointer<communication::PhonString>> agrees_to = {};
  /// It was begun before, and could be done in part only.
  bool was_begun = false;

  friend bool operator==(const RequestedStep&, const RequestedStep&) = default;
};

/// Entry: the steps that a TableMotives has to see to, so that its successor does. Its id is
/// `requested_steps`.
struct RequestedSteps {
  std::vector<RequestedStep> waiting;
  /// The step that is done now, its motive, and what to say when it is done. Without an id there is
  /// none.
  RequestedStep current;
  Address motive;
  std::string result;
  /// The current step is over, and nothing had to be done for it.
  bool was_so = false;
  /// Proxies of the things with which it is done: of "one of the balls" the one that was chosen.
  std::vector<std::string> chosen = {};
  /// Those of the request that could not be done last, until another step is begun.
  std::vector<RequestedStep> given_up;
  /// Those that were not done yet when people said "stop", until another step is begun.
  std::vector<RequestedStep> stopped;
  /// People said "wait", and nothing since that ends it.
  bool is_paused = false;

  friend bool operator==(const RequestedSteps&, const RequestedSteps&) = default;
};

inline constexpr const char* requested_steps = "requested steps";

CASTOR_REFLECT(TableProblem, reason, help, has_begun)
CASTOR_REFLECT(TableGoalRequest, step, begins, because)
CASTOR_REFLECT(TableGoalReply, refusal, goal, words, result, things, is_impossible)
CASTOR_REFLECT(RequestedStep, move, what, agrees_to, was_begun)
CASTOR_REFLECT(RequestedSteps, waiting, current, motive, result, chosen, given_up, stopped,
               is_paused, was_so)
CASTOR_REFLECT(RememberedQuality, kind, value)
CASTOR_REFLECT(RememberedThing, name, id, proxy, qualities, place, radius, height, waypoint,
               waypoint_before, is_held, on, former_proxies, waypoint_before_goal,
               waypoint_at_first, is_kept, is_kept_clear, waypoint_noted, lengths, has_returned)
CASTOR_REFLECT(RememberedWaypoint, name, place)
CASTOR_REFLECT(RememberedChoice, waypoint, wanted)
CASTOR_REFLECT(RememberedMove, thing, words, because)
CASTOR_REFLECT(RememberedTable, things, waypoints, chosen, done, next_waypoint, moves, last_moves,
               because)

} // namespace castor::planning
