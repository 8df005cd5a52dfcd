#pragma once

#include "castor/planning/motivation/table_room.hpp"

#include <vector>

/// How things can stand to each other.
namespace castor::planning::layouts {

/// Of each thing from the middle of all, metres.
using Offsets = std::vector<TablePoint>;
using Things = std::vector<const TableThing*>;

TablePoint middle_of(const Things& things);
std::vector<TablePoint> places_around(const TablePoint& middle, const Offsets& offsets);

// With narrow and with wider gaps; by their ranks from left to right, in the order in which they
// are given, or from front to back.
std::vector<Offsets> in_row(const Things& things);
std::vector<Offsets> in_row_as_named(const Things& things);
std::vector<Offsets> in_column(const Things& things);

/// The half that is nearer in front, each from left to right.
Offsets in_two_rows(const Things& things);
Offsets in_ring(const Things& things, const TablePoint& middle);
/// Farther from their middle by a factor.
Offsets apart(const Things& things, const TablePoint& middle, double factor);

} // namespace castor::planning::layouts
