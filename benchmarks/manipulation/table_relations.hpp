#pragma once

#include "castor/benchmarks/manipulation/table_tasks.hpp"

#include <map>
#include <string>
#include <vector>

/// What the words of table tasks mean, metres in the table's frame.
namespace castor::manipulation {

/// What the table's things may be put on.
inline constexpr double half_width = 0.30;
inline constexpr double half_depth = 0.26;
/// Of what counts as done.
inline constexpr double gap_tolerance = 0.01;
/// What has changed places is so near to where the other was.
inline constexpr double same_place = 0.05;

double distance(const Spot& a, const Spot& b);

/// By the names that the simulated table gives them.
std::map<std::string, const RandomThing*> by_name(const TableTask& task);

/// Whether a thing at one place is left, right, front, back or near of a landmark at another.
/// @param is_strict without the tolerance of what counts as done
bool is_at(const std::string& relation, const RandomThing& thing, const Spot& at,
           const RandomThing& landmark, const Spot& other, bool is_strict);

/// How far beyond the table's middle, on that side.
double on_side(const std::string& side, const Spot& at);

bool is_wholly_on(const std::string& side, const RandomThing& x, const Spot& at);

/// Colours from the left, by the middles of their things.
std::vector<std::string> colours_from_left(const std::vector<RandomThing>& things);

} // namespace castor::manipulation
