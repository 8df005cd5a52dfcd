#include "castor/planning/motivation/table_places.hpp"

#include <cmath>

namespace castor::planning {

namespace {

/// What is no nearer says nothing of a place, metres.
constexpr double landmark_distance = 0.25;

/// Two things are no nearer to each other; another one is at the place itself then, metres.
constexpr double same_place = 0.03;

} // namespace

std::string place_in_words(const TableSpot& place, const TableThing& own,
                           std::span<const TableThing> table) {
  const TableThing* nearest = nullptr;
  double least = landmark_distance;
  for (const auto& x : table)
    if (const auto gap = std::hypot(x.x - place.x, x.y - place.y);
        x.object != own.object && !x.is_held && gap < least) {
      nearest = &x;
      least = gap;
    }
  const double dx = place.x - (nearest == nullptr ? 0 : nearest->x);
  const double dy = place.y - (nearest == nullptr ? 0 : nearest->y);
  const bool is_beside = std::abs(dx) > std::abs(dy);
  if (nearest == nullptr)
    return is_beside ? (dx < 0 ? "on the left" : "on the right")
                     : (dy < 0 ? "at the front" : "at the back");
  const auto there = "where " + nearest->words + " is now";
  if (least < same_place)
    return there;
  const std::string side = is_beside ? (dx < 0 ? "to the left of " : "to the right of ")
                                     : (dy < 0 ? "in front of " : "behind ");
  return side + there;
}

} // namespace castor::planning
