#pragma once

#include "castor/planning/motivation/table_goals.hpp"
#include "castor/planning/motivation/table_room.hpp"
#include "castor/planning/motivation/table_words.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor::planning {

/// Makes the goal of one step of a request.
class TableGoalMaker {
public:
  using Things = std::vector<const TableThing*>;
  using DirectivePlace = communication::DirectivePlace;
  using DirectiveStep = communication::DirectiveStep;

  /// The step and the table have to outlive it.
  TableGoalMaker(const DirectiveStep& step, std::span<const TableThing> table, TableReach reach,
                 TableExchange exchange, TableLanding landing);

  TableGoal make();

private:
  const TableThing* thing(const std::string& proxy) const;
  TableGoal goal(std::string words, std::string result);
  std::vector<std::string> proxies() const;
  std::string in_part(const TableThing& x, std::string part);
  std::string but_what_is_kept() const;
  TableGoal refusal_for_kept() const;

  TableGoal manage();
  TableGoal leave_kept();
  TableGoal handle();
  void choose();
  TableGoal each(const std::string& predicate, const std::string& verb);
  std::string done_before_taking() const;
  TableGoal give();
  void hold_held();
  TableGoal put_down();
  TableGoal swap();
  TableGoal clear();
  TableGoal sort();
  TableGoal sort_one_of_each();
  void stand_in_strips(const std::vector<Things>& groups);

  // -- pushing (table_goals_push.cpp)
  bool is_push_away() const;
  TableGoal push();
  TableGoal push_anywhere(double distance);
  std::optional<std::string> push_one(const TableThing& x, const DirectivePlace& place,
                                      double& distance);

  // -- questions (table_answers.cpp)
  TableGoal answer_question() const;
  TableGoal have_moved() const;
  Things those_moved() const;
  TableGoal how_far_moved() const;
  TableGoal what_is_kept() const;
  TableGoal may_touch() const;
  TableGoal how_far() const;
  TableGoal extreme_pair(bool is_closest) const;
  TableGoal how_large(bool is_height) const;
  TableGoal height_of_tower() const;
  TableGoal list_in_order() const;
  TableGoal displaced() const;
  TableGoal touching() const;

  // -- what was before (table_goals_back.cpp)
  TableGoal put_back();
  bool has_landmark_that_was_moved() const;
  TableGoal put_as_noted();
  TableGoal undo();
  TableGoal restore();
  void back_to(const TableThing& x, const std::string& waypoint);
  TableGoal return_goal(const std::string& words, const std::string& result);
  static std::string waypoint_to_return_to(const TableThing& x);
  std::string it_was() const;
  TableGoal where_was() const;

  // -- places (table_goals_places.cpp); those with an optional result say why it is impossible
  TableGoal put();
  TableGoal arrange(const std::string& arrangement, const std::string& side = {});
  TableGoal arrange_at(const std::string& arrangement, const std::string& side);
  void stand_at(std::vector<TableSpot> spots);
  TableGoal put_where_another_is(const DirectivePlace& place, const std::string& verb);
  std::optional<std::string> put_further(const Shifted& way, std::string& where);
  std::optional<std::string> put_in_part(const DirectivePlace& place, std::string& where);
  const TableThing* thing_in_middle() const;
  std::optional<std::string> put_at_landmarks(const DirectivePlace& place, std::string& where);
  std::optional<std::string> put_on(const Things& landmarks) const;
  std::string on_another(const TableThing& below) const;
  std::optional<std::string> beyond_reach(const TableThing& x, const TableThing& other) const;
  Things without_upper_ones(Things landmarks) const;
  static Things without_lower_ones(const Things& landmarks);
  std::optional<TableSpot> spot_nearly_at(const TableThing& x, const TableThing& other) const;

  // -- measured places (table_goals_spots.cpp)
  std::optional<std::string> put_at_spot(const DirectivePlace& place, std::string& where);
  TableGoal put_on_both_sides(const DirectivePlace& place);
  const TableThing* top_of_stack() const;
  std::optional<std::string> put_on_top(std::string& where);
  TableGoal sort_in_row();

  // -- corners (table_goals_corners.cpp)
  TableGoal put_in_each_corner();
  bool is_corner_reached(const TableThing& x, std::string_view corner) const;
  /// A place at an edge, or as near to it as the arm can put something.
  struct EdgeSpot {
    TableSpot spot;
    bool is_at_edge = true;
    /// Of what is put there, metres.
    double radius = 0;
  };
  std::optional<EdgeSpot> spot_at_edge(const TableThing& x, std::string_view edge,
                                       std::span<const EdgeSpot> taken) const;
  std::vector<EdgeSpot> spots_at_edge(std::string_view edge) const;
  std::optional<TableSpot> spot_as_near_to(const TableThing& x, std::string_view part) const;
  std::string corner_for_all() const;
  std::optional<std::string> put_in_opposite_corner(std::string& where);

  const DirectiveStep& step_;
  std::span<const TableThing> table_;
  TableRoom room_;
  TableExchange exchange_;
  Things things_;
  /// Those of the step that are not to be touched.
  Things kept_;
  std::vector<std::string> facts_;
  std::vector<std::string> parts_;
  std::vector<TableSpot> spots_;
  std::size_t places_ = 0;
  double push_distance_ = 0;
};

TableGoal refusal(std::string words);

/// The thing that requests refer to by a proxy; null if there is none.
const TableThing* find_thing(std::span<const TableThing> table, const std::string& proxy);

/// "The ball, the box and the disc". @param last joins the last one to those before
std::string listed(const std::vector<const TableThing*>& things, std::string_view last = "and");
std::string are(const std::vector<const TableThing*>& things);

/// The fact that it is there.
std::string at_waypoint(const TableThing& x, const std::string& waypoint);

/// With a capital and a full stop.
std::string sentence(std::string words);

} // namespace castor::planning
