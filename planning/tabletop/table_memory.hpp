#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/planning/motivation/table_goals.hpp"
#include "castor/planning/motivation/table_history.hpp"
#include "castor/planning/tabletop/things_in_way.hpp"
#include "castor/planning/tabletop/types.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace castor::planning {

/// A thing as it is seen and bound now; metres, in the table's frame.
struct ThingOnTable {
  /// Of its SceneObject.
  std::string id;
  /// By which requests refer to it.
  std::string proxy;
  /// Its colour, shape and size, as far as they are known.
  std::map<std::string, std::string, std::less<>> qualities = {};
  spatial::GroundPoint place;
  /// Of the disc that it fits in.
  double radius = 0.03;
  double height = 0.05;
  /// Of its sides, as binding knows them; the third is its height. All 0 if they are not known.
  geometry::Point3 lengths = {};
};

/// Where something is; things by the ids of their SceneObjects.
struct ThingAtPlace {
  std::string id;
  spatial::WantedPlace place;
  /// As of HeldPlace.
  bool is_close = true;
};

/// What a planner has to know of a table that is not to be seen: which thing is which after it was
/// moved, what stands on another, what is held, and the places that were chosen but where nothing
/// is yet. Names of objects are kept for as long as a thing is there.
class TableMemory {
public:
  struct Thing {
    /// The planner's name.
    std::string name;
    /// As it was seen last.
    ThingOnTable seen;
    std::string waypoint;
    std::string waypoint_before = {};
    bool is_held = false;
    /// Name of the thing that it stands on; vision may see both as one. Empty for the table.
    std::string on = {};
    /// Proxies that it had before: requests may refer to it by them.
    std::vector<std::string> former_proxies = {};
    /// Where it was when the last goal began that moved something; empty if that did not move it.
    std::string waypoint_before_goal = {};
    /// Where it was before it was moved for the first time; empty if it was not moved.
    std::string waypoint_at_first = {};
    /// Somebody has said that it is not to be touched, or that nothing is to be put on it.
    bool is_kept = false;
    bool is_kept_clear = false;
    /// Where it was when people said to remember that.
    std::string waypoint_noted = {};
    /// It was last moved to put it where it was before.
    bool has_returned = false;
  };

  /// @param agent who acts, and nouns by shapes: "ball" for "sphere"
  explicit TableMemory(std::string agent, std::map<std::string, std::string> nouns = {});

  /// All that is seen now. What is not seen any more, and is neither held nor on another thing, is
  /// taken for something new that looks like it, or is forgotten.
  /// @param is_complete false while others do not know yet all that vision sees: nothing is
  /// forgotten then
  void see(const std::vector<ThingOnTable>& things, bool is_complete = true);

  // -- for a successor

  RememberedTable remembered() const;
  /// Knows what a predecessor did, and nothing else. What refers to something that is not in it is
  /// left out.
  void recall(const RememberedTable& x);

  // -- what is asked for

  /// For goals. @param places where things are, in parts of the table
  std::vector<TableThing> things(const std::vector<ThingAtPlace>& places) const;
  /// Begins a goal: forgets what was chosen for another, and reserves its new places.
  /// @param because what it is done for: "you said 'put the ball there'"
  AchieveGoal begin(const TableGoal& goal, const std::string& because = {});
  /// Things are not to be touched from now on, nothing is to be put on them, or both is allowed, as
  /// the goal says.
  void keep(const TableGoal& goal);
  /// Whether something was moved for the goal.
  bool has_moved() const { return !is_unmoved_; }
  /// Remembers where things are now.
  void note_places();
  /// The moves that were made.
  const TableHistory& history() const { return history_; }

  // -- for the planner

  /// @param goal for whose waypoints and parts it is
  StateReply state(std::string_view goal, const std::vector<ThingAtPlace>& places) const;

  /// Null if there is no such thing.
  const Thing* thing(std::string_view name) const;
  const Thing* with_id(std::string_view id) const;

  // -- steps of plans

  /// "reposition-left robot place-4 box": a place is chosen where nothing is yet.
  /// @param arguments of the step, after the agent
  void choose(const std::string& step, const std::vector<std::string>& arguments);
  /// What was chosen, with names of things; empty for a place where something was before.
  std::vector<spatial::WantedPlace> chosen(const std::string& waypoint) const;
  /// Where something was. Null for what was chosen.
  const spatial::GroundPoint* place(const std::string& waypoint) const;

  /// Where the goal says that a thing is to be in the end; null if it says of no point.
  const spatial::GroundPoint* wanted_place(std::string_view name) const;

  /// How far the goal has things pushed, metres.
  double push_distance() const { return push_distance_; }
  /// Whether the goal has things pushed there, and not carried.
  bool is_pushed_to(const std::string& waypoint) const { return pushed_to_.contains(waypoint); }

  /// From now on the arm carries it, with stops maybe: where it is seen meanwhile, it was put. That
  /// is one move.
  void carries(const std::string& name);
  /// It is at a waypoint now. @param id of the SceneObject that it is seen as; empty if it is not
  /// seen there, because it stands on another thing
  void moved(const std::string& name, const std::string& waypoint, const std::string& id,
             spatial::GroundPoint place);
  void taken(const std::string& name);
  /// The thing that was seen as that SceneObject is in the gripper, whoever has taken it; nothing
  /// else is.
  void holds(std::string_view id);
  /// Nothing is held any more, wherever it is.
  void released();
  void pushed(const std::string& name);
  /// It cannot be moved because of those things. Where all of them are things that a goal is about,
  /// they are moved before.
  /// @param in_way ids of their SceneObjects; what is not known here does not count
  void refused(const std::string& name, const std::vector<std::string>& in_way);

private:
  Thing* find(std::string_view name);
  static void see_as(Thing& known, const ThingOnTable& seen);
  void leave(Thing& x);
  static void keep_form(Thing& x, const ThingOnTable& before);
  void see_stacks(std::vector<const ThingOnTable*>& others, std::set<std::string>& seen,
                  const std::set<std::string>& loaded);
  std::string new_waypoint(spatial::GroundPoint place);
  std::string words(const Thing& x) const;
  bool is_free(const std::string& waypoint, std::string_view goal) const;
  bool is_near(const Thing& x, const std::string& waypoint) const;
  void tell_order(std::string_view goal, StateReply& reply) const;
  void tell_thing(const Thing& x, StateReply& reply) const;
  static void tell_place(const std::string& waypoint, const spatial::WantedPlace& place,
                         StateReply& reply);

  std::string agent_;
  std::map<std::string, std::string> nouns_;
  std::vector<Thing> things_;
  std::map<std::string, spatial::GroundPoint> waypoints_;
  std::map<std::string, std::vector<spatial::WantedPlace>> chosen_;
  /// Facts of the goal that nobody sees.
  std::set<std::string> done_;
  /// Where things were put for the goal relative to others, as facts.
  std::set<std::string> put_there_;
  ThingsInWay in_way_;
  /// The formula of the goal that has begun.
  std::string goal_;
  double push_distance_ = 0;
  std::set<std::string> pushed_to_;
  /// Nothing has been moved for the goal yet.
  bool is_unmoved_ = true;
  /// The thing that the arm carries, or has left at a stop; empty if there is none.
  std::string carried_;
  /// That is counted as a move already.
  bool has_carried_left_ = false;
  TableHistory history_;
  /// What the goal that has begun is done for.
  std::string because_;
  bool is_return_ = false;
  std::size_t next_waypoint_ = 1;
};

} // namespace castor::planning
