#pragma once

#include "castor/communication/types.hpp"
#include "castor/planning/motivation/table_reach.hpp"
#include "castor/planning/motivation/table_things.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What requests about things on a table ask to reach, for the planner:
/// configs/domains/playmate.pddl has the predicates.
namespace castor::planning {

enum class TableWish {
  /// Something is to be reached.
  goal,
  /// What is done is to end, to pause, and to go on.
  stop,
  wait,
  go_on,
  /// Something is only asked.
  answer,
  /// Things are not to be touched, nothing is to be put on them, and both is allowed again.
  keep,
  keep_clear,
  allow,
  /// Where things are now is to be remembered.
  note,
  /// It is impossible.
  refusal
};

/// What one step of a request asks for.
struct TableGoal {
  TableWish wish = TableWish::goal;
  /// For the planner: "(and (left-of ball box))".
  std::string formula;
  /// The parts of the table that it speaks of, objects of the planner.
  std::vector<std::string> parts;
  /// Number of waypoints that have to be chosen to reach it: one for each thing, and one to spare.
  std::size_t new_places = 0;
  /// What is to be done, as an infinitive, or a sentence: of a refusal why not, of a
  /// question the answer.
  std::string words;
  /// What to say once it is so, a sentence.
  std::string result = {};
  /// Waypoints that the formula has besides those of things.
  std::vector<TableSpot> spots = {};
  /// Proxies of the things that it is about, as requests have them.
  std::vector<std::string> things = {};
  /// How far things are pushed, metres: to the spots if there are any, otherwise anywhere; 0 if
  /// they are not.
  double push_distance = 0;
  /// Things are put where they were before.
  bool is_return = false;

  friend bool operator==(const TableGoal&, const TableGoal&) = default;
};

/// Facts for the planner: relations that the goal's formula does not speak of, "(unasked
/// rel-left)", so that no places are chosen in them.
std::vector<std::string> unasked_relations(std::string_view formula);

/// Whether a step asks something of what was done or seen: nothing is to be reached for it.
bool is_question(std::string_view action);

/// The goal of a step, or why there is none. "One of the balls" is any: of several that will do the
/// first is taken. Where spots are chosen or said, they are where things can be put.
/// @param exchange may be empty: then places of others are taken as the reach says
/// @param landing may be empty: then places of arrangements are taken as the reach says
TableGoal goal_of(const communication::DirectiveStep& step, std::span<const TableThing> table,
                  TableReach reach = reach_in_box, TableExchange exchange = {},
                  TableLanding landing = {});

/// A failed action in words: "I cannot take the ball: the box is in the way."
std::string explained(std::string_view action, std::string_view reason);

} // namespace castor::planning
