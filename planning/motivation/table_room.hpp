#pragma once

#include "castor/planning/motivation/table_landings.hpp"
#include "castor/planning/motivation/table_reach.hpp"
#include "castor/planning/motivation/table_things.hpp"

#include <cmath>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>

/// Where there is room for what is put on a table.
namespace castor::planning {

/// From the middle of the table: to the right, and away; metres.
struct TablePoint {
  double x = 0;
  double y = 0;
};

/// Steps in which room is looked for, metres.
inline constexpr double room_step = 0.01;

inline TablePoint place_of(const TableThing& x) {
  return {x.x, x.y};
}

inline double distance(const TablePoint& a, const TablePoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// From rim to rim, if one thing stands at `a` and the other one at `b`; metres.
inline double gap_between(const TableThing& x, const TablePoint& a, const TableThing& y,
                          const TablePoint& b) {
  return distance(a, b) - x.radius - y.radius;
}

/// Where they stand.
inline double gap_between(const TableThing& x, const TableThing& y) {
  return gap_between(x, place_of(x), y, place_of(y));
}

/// "spot-of-" and its object.
TableSpot spot_for(const TableThing& thing, const TablePoint& at);

/// The things of a table, and where they can be put.
class TableRoom {
public:
  /// The things have to outlive it.
  /// \param landing as of TableLandings
  explicit TableRoom(std::span<const TableThing> table, TableReach reach = reach_in_box,
                     TableLanding landing = {});

  std::span<const TableThing> things() const { return table_; }

  /// Whether a thing can be put there at all.
  bool can_be_put(const TableThing& thing, const TablePoint& at) const;

  /// How much farther a thing may rather be moved than be put there, metres; nothing if it cannot
  /// be, or would stand over the table's edge.
  std::optional<double> effort(const TableThing& thing, const TablePoint& at) const;

  /// What the arm says of single places.
  TableLandings& landings() const { return *landings_; }

  /// From a thing's rim, if it were there, to the nearest other one on the table, metres; infinite
  /// without one.
  /// \param left_out they are not in its way, nor is what stands on it
  double room_around(const TablePoint& at, const TableThing& thing,
                     std::initializer_list<const TableThing*> left_out = {}) const;

private:
  std::span<const TableThing> table_;
  TableReach reach_;
  std::shared_ptr<TableLandings> landings_;
};

} // namespace castor::planning
