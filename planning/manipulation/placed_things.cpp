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

void PlacedThings::put(const std::string& id, const SeenThing& before, const Pose& pose,
                       double fall) {
  auto thing = before;
  thing.id = id;
  thing.thing.pose = pose;
  things_.insert_or_assign(id, Placed{std::move(thing), fall});
}

double PlacedThings::fall_of(const std::string& id) const {
  const auto found = things_.find(id);
  return found == things_.end() || found->second.is_seen ? 0 : found->second.fall;
}

void PlacedThings::correct(std::vector<SeenThing>& things) {
  std::map<std::string, Placed> still_there;
  for (auto& [id, placed] : things_) {
    auto& thing = placed.thing;
    const bool is_on_another = is_stacked(thing.thing);
    const auto is_it = [&, &at = thing.thing.pose.position](const SeenThing& seen) {
      const double off = same_place + (is_on_another ? seen_off(at.z) : 0);
      return seen.colour == thing.colour && distance_on_table(seen.thing.pose.position, at) <= off;
    };
    auto seen = std::ranges::find(things, id, &SeenThing::id);
    // In a stack, what is put on a thing hides some of it: vision may take the rest for a new
    // thing.
    if (seen == things.end() && is_on_another)
      seen = std::ranges::find_if(
        things, [&](const SeenThing& x) { return is_it(x) && !things_.contains(x.id); });
    if (seen == things.end() || !is_it(*seen))
      continue;
    placed.is_seen = !is_on_another && are_as_large(seen->thing.solid, thing.thing.solid);
    if (!placed.is_seen) {
      seen->thing.solid = thing.thing.solid;
      seen->thing.pose = thing.thing.pose;
    }
    thing.id = seen->id;
    still_there.insert_or_assign(seen->id, std::move(placed));
  }
  things_ = std::move(still_there);
  // What another thing stands on is not higher than where that was put.
  for (const auto& [id, placed] : things_)
    if (const auto& x = placed.thing.thing; is_stacked(x))
      for (auto& y : things)
        if (y.id != id && y.thing.pose.position.z < x.pose.position.z &&
            distance_on_table(y.thing.pose.position, x.pose.position) < outer_radius(y.thing.solid))
          y.thing.higher = 0;
}

} // namespace castor::manipulation
