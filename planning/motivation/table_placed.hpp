#pragma once

#include "castor/planning/motivation/table_room.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace castor::planning {

/// Things at places of a table.
class TablePlaced {
public:
  using Things = std::vector<const TableThing*>;

  /// @param places one for each thing; things and room have to outlive it
  /// @param left_out others that they may stand in the way of
  TablePlaced(std::vector<TablePoint> places, const Things& things, const TableRoom& room,
              Things left_out = {});

  /// How much is to be moved, metres: those that are moved, how far, and to where that is harder.
  /// Nothing if they do not fit there: where they can be put, and off all others; or if they cannot
  /// be put there one after the other.
  std::optional<double> effort() const;

  /// Whether the arm itself says that each that is moved can be put at its place.
  bool land() const;

  std::vector<TableSpot> spots() const;

private:
  bool stays(std::size_t i) const;
  bool is_too_near(std::size_t i, const TablePoint& at, const TableThing& other) const;
  bool is_apart(std::size_t i) const;
  bool is_free_of_others(std::size_t i) const;

  const Things& things_;
  const TableRoom& room_;
  Things left_out_;
  std::vector<TablePoint> at_;
};

} // namespace castor::planning
