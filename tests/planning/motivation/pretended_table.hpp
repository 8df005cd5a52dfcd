#pragma once

#include "castor/binding/types.hpp"
#include "castor/perception/spatial/table_places.hpp"
#include "castor/planning/motivation/table_goals.hpp"
#include "castor/tests/communication/table_scene.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::planning::test {

struct PretendedThing {
  std::string name;
  std::string shape;
  std::string colour;
  spatial::GroundPoint place;
  double side = 0.06;
};

/// A table with things, and a body that does at once what the steps of plans say: it puts things
/// where the target finder says. What is near, left ... follows from where they are.
class PretendedTable {
public:
  explicit PretendedTable(const std::vector<PretendedThing>& things);

  /// What binding would know of it.
  std::unique_ptr<communication::test::TableScene> scene() const;

  /// What requests are about.
  std::vector<TableThing> things(const std::vector<std::string>& parts) const;

  /// Begins a goal: knows its spots from now on, by names of their own, which the goal gets.
  TableGoal begin(TableGoal goal);

  /// A problem of the domain playmate.
  std::string problem(const TableGoal& goal) const;

  /// Does a step such as "move arm a free-1".
  /// \returns why it is impossible; empty if it is done
  std::string execute(const std::string& step);

  spatial::GroundPoint place(const std::string& thing) const;

  std::size_t moves() const { return moves_; }

  /// Whether two things stand in each other.
  bool has_collision() const;

private:
  struct Thing {
    PretendedThing what;
    std::string waypoint;
    std::string waypoint_before;
    std::optional<std::size_t> on;

    bool is_on_table() const { return waypoint != "hand"; }
  };

  std::size_t index(const std::string& name) const;
  std::vector<spatial::TableObject> objects() const;
  spatial::TablePlaces places() const;
  bool is_free(const std::string& waypoint, const TableGoal& goal) const;
  bool has_to_wait(const Thing& x, const Thing& other, const TableGoal& goal) const;
  void choose(const std::string& waypoint, const std::string& relation,
              std::vector<std::size_t> landmarks);
  std::string move(std::size_t thing, const std::string& to);

  std::vector<Thing> things_;
  /// Where things are or were.
  std::map<std::string, spatial::GroundPoint> waypoints_;
  std::map<std::string, std::vector<spatial::PlaceWanted>> chosen_;
  std::size_t moves_ = 0;
  std::size_t spots_ = 0;
};

} // namespace castor::planning::test
