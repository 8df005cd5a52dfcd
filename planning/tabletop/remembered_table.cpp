#include "castor/planning/tabletop/table_memory.hpp"

#include <string>
#include <utility>

namespace castor::planning {

RememberedTable TableMemory::remembered() const {
  RememberedTable result;
  for (const auto& x : things_) {
    RememberedThing thing{x.name,
                          x.seen.id,
                          x.seen.proxy,
                          {},
                          x.seen.place,
                          x.seen.radius,
                          x.seen.height,
                          x.waypoint,
                          x.waypoint_before,
                          x.is_held,
                          x.on,
                          x.former_proxies,
                          x.waypoint_before_goal,
                          x.waypoint_at_first,
                          x.is_kept,
                          x.is_kept_clear,
                          x.waypoint_noted,
                          x.seen.lengths,
                          x.has_returned};
    for (const auto& [kind, value] : x.seen.qualities)
      thing.qualities.push_back({kind, value});
    result.things.push_back(std::move(thing));
  }
  for (const auto& [name, place] : waypoints_)
    result.waypoints.push_back({name, place});
  for (const auto& [waypoint, wanted] : chosen_)
    result.chosen.push_back({waypoint, wanted});
  result.done.assign(done_.begin(), done_.end());
  result.next_waypoint = next_waypoint_;
  result.because = because_;
  result.moves = history_.moves;
  for (const auto& move : history_.remembered)
    result.last_moves.push_back({move.object, move.words, move.because});
  return result;
}

void TableMemory::recall(const RememberedTable& x) {
  things_.clear();
  waypoints_.clear();
  chosen_.clear();
  done_ = {x.done.begin(), x.done.end()};
  next_waypoint_ = x.next_waypoint;
  because_ = x.because;
  history_ = {x.moves, {}};
  for (const auto& move : x.last_moves)
    history_.remembered.push_back({move.thing, move.words, move.because});
  for (const auto& waypoint : x.waypoints)
    waypoints_[waypoint.name] = waypoint.place;
  for (const auto& choice : x.chosen)
    chosen_[choice.waypoint] = choice.wanted;
  for (const auto& thing : x.things) {
    if (!waypoints_.contains(thing.waypoint))
      continue;
    ThingOnTable seen{thing.id,     thing.proxy,  {},           thing.place,
                      thing.radius, thing.height, thing.lengths};
    for (const auto& quality : thing.qualities)
      seen.qualities.emplace(quality.kind, quality.value);
    things_.push_back({thing.name, std::move(seen), thing.waypoint, thing.waypoint_before,
                       thing.is_held, thing.on, thing.former_proxies, thing.waypoint_before_goal,
                       thing.waypoint_at_first, thing.is_kept, thing.is_kept_clear,
                       thing.waypoint_noted, thing.has_returned});
  }
  for (auto& y : things_)
    if (thing(y.on) == nullptr)
      y.on.clear();
}

} // namespace castor::planning
