#include "castor/planning/manipulation/placed_things.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::manipulation {

namespace {

// What is seen further from where it was put has been moved since, metres.
constexpr double same_place = 0.035;
// Lengths that differ by more are seen wrongly: a share, and metres.
constexpr double most_share = 0.1;
constexpr double most_off = 0.003;

bool are_as_long(double a, double b) {
  return std::abs(a - b) <= most_off + most_share * std::max(a, b);
}

bool are_as_large(const Solid& a, const Solid& b) {
  return a.kind == b.kind && are_as_long(a.size.x, b.size.x) && are_as_long(a.size.y, b.size.y) &&
         are_as_long(a.size.z, b.size.z);
}

/// What stands on another thing looks as if it were larger, and stood on the table behind it.
bool is_stacked(const NamedSolid& x) {
  constexpr double above_table = 0.01;
  return x.pose.position.z - half_height(x.solid, x.pose.rotation) > above_table;
}

} // namespace

void PlacedThings::put(const std::string& id, const SeenThing& before, const Pose& pose) {
  auto thing = before;
  thing.id = id;
  thing.thing.pose = pose;
  things_.insert_or_assign(id, std::move(thing));
}

void PlacedThings::correct(std::vector<SeenThing>& things) {
  std::erase_if(things_, [&](const auto& x) {
    const auto& placed = x.second;
    const auto seen = std::ranges::find(things, placed.id, &SeenThing::id);
    const double off =
      same_place + (is_stacked(placed.thing) ? seen_off(placed.thing.pose.position.z) : 0);
    if (seen == things.end() || seen->colour != placed.colour ||
        distance_on_table(seen->thing.pose.position, placed.thing.pose.position) > off)
      return true;
    if (is_stacked(placed.thing) || !are_as_large(seen->thing.solid, placed.thing.solid)) {
      seen->thing.solid = placed.thing.solid;
      seen->thing.pose = placed.thing.pose;
    }
    return false;
  });
}

} // namespace castor::manipulation
