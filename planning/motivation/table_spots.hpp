#pragma once

#include "castor/planning/motivation/table_room.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

/// Places that are measured, where relations as people see them are not exact enough.
namespace castor::planning {

/// Whether a relation is measured: midway between two things, as far from both, in line with them
/// or level with one, on its other side, where there is most room, closer to one or farther; or any
/// that a distance is said with.
bool is_measured(std::string_view relation, double distance);

/// Whether it may be said of so many landmarks.
bool takes_landmarks(std::string_view relation, std::size_t number);

/// Number of landmarks that it takes, the larger one of two.
std::size_t landmarks_needed(std::string_view relation);

/// The spot for a thing, where it can be put and off what stands there; of several those where it
/// can be put best, and of these the nearest to where it is. Nothing if there is no room.
///
/// - `midway`: half-way between two things
/// - `equidistant`: as far from both
/// - `in-line`: on the line through both; with one, in its row or its column
/// - `level`, `level-across`: in the row of one thing from left to right, in its column
/// - `centre`: so far towards the middle of the table
/// - `left-edge` and the others, `edge`: so far from that edge of the table, or from the nearest
/// - `other-side`: where it is now, seen from the other side of one thing
/// - `roomiest`: as far as possible from everything
/// - `closer`, `farther`: on the line from one thing to where it is, with half the gap or a wider
/// one;
///   the distance is what the gap changes by
/// - `left`, `right`, `front`, `back`, `near`: so that the gap is as wide as said
///
/// @param landmarks as many as `landmarks_needed`, of the table
std::optional<TableSpot> measured_spot(std::string_view relation, double distance,
                                       const TableThing& thing,
                                       const std::vector<const TableThing*>& landmarks,
                                       const TableRoom& room);

/// Spots for two things on both sides of a third, as far from it: left and right of it, or before
/// and behind it. Empty if there is no room.
std::vector<TableSpot> both_sides(const std::vector<const TableThing*>& two,
                                  const TableThing& middle, const TableRoom& room);

/// Whether a place is on the table at all.
bool is_on_table(double x, double y);

} // namespace castor::planning
