#pragma once

#include "castor/perception/spatial/types.hpp"
#include "castor/planning/motivation/table_things.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Where on a table things can be put.
namespace castor::planning {

/// The table, from its middle; metres. As in spatial's TableArea.
inline constexpr double table_half_width = 0.30;
inline constexpr double table_half_depth = 0.26;

/// How a thing can be put at a point, metres.
using TableReach = std::function<spatial::Reach(const TableThing& thing, double x, double y)>;

/// Why a thing cannot be put where another is, once that has left: a clause, empty if it can be;
/// nothing if that is not known.
using TableExchange =
  std::function<std::optional<std::string>(const TableThing& thing, const TableThing& other)>;

/// How the arm itself says that a thing can be put at points, by the ways in which it can take it
/// where it is: direct, by_stop or none for each; empty if that is not known. It takes longer,
/// above all where places between are to be found.
using TableLanding = std::function<std::vector<spatial::Reach>(
  const TableThing& thing, const std::vector<spatial::GroundPoint>& points, bool may_put_between)>;

/// Where no arm has told where it reaches: in a box around the middle of the table, and perhaps
/// elsewhere on it.
spatial::Reach reach_in_box(const TableThing& thing, double x, double y);

/// As spatial has told it. \param objects the planner's names of the things that it was told for,
/// in that order; others may be put anywhere in the box
TableReach reach_told(spatial::ReachQuery told, std::vector<std::string> objects);

/// How much farther a thing may rather be moved than be put somewhere in that way, metres; nothing
/// if it cannot be put there.
std::optional<double> effort_of(spatial::Reach reach);

} // namespace castor::planning
