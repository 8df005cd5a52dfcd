#pragma once

#include "castor/perception/spatial/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/motivation/table_reach.hpp"
#include "castor/planning/tabletop/components/knows_table.hpp"
#include "castor/planning/tabletop/goal_text.hpp"
#include "castor/planning/tabletop/table_memory.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

/// A component that knows where on a table things are to be put, and whether they are there: by a
/// TargetFinder.
class FindsPlaces : public KnowsTable {
protected:
  struct Target {
    manipulation::TablePlace to;
    /// It is known that it takes a stop on the way.
    bool takes_stop = false;
  };

  /// \param reason becomes that why there are none
  std::vector<Target> targets_of(const TableMemory::Thing& thing, const std::string& waypoint,
                                 std::string& reason) {
    const auto wanted = memory_.chosen(waypoint);
    if (wanted.empty()) {
      const auto* place = memory_.place(waypoint);
      if (place == nullptr) {
        reason = "I do not know any more where that place is";
        return {};
      }
      return {{table_place(*place)}};
    }
    spatial::PlacementQuery query;
    if (!thing.is_held)
      query.thing = location_of(thing.seen.id);
    query.radius = thing.seen.radius;
    query.height = thing.seen.height;
    query.requested_targets = static_cast<std::uint32_t>(places_.get());
    if (const auto* then = memory_.wanted_place(thing.name))
      query.onward.push_back(*then);
    for (const auto& x : wanted) {
      auto& place = query.places.emplace_back(spatial::WantedPlace{x.relation, {}});
      for (const auto& landmark : x.landmarks) {
        auto at = location_seen(landmark);
        if (at.empty()) {
          reason = "what it is to be put there for is not seen any more";
          return {};
        }
        place.landmarks.push_back(std::move(at));
      }
    }
    query = call<spatial::PlacementQuery, spatial::PlacementQuery>(spatial(), query,
                                                                   {.timeout = patience()});
    reason = query.reason;
    if (!query.on.empty()) {
      manipulation::TablePlace on;
      on.on = EntryPointer<vision::SceneObject>{Address{vision(), object_at(query.on)}};
      return {{on}};
    }
    std::vector<Target> result;
    for (const auto& x : query.targets)
      result.push_back({table_place(x.position), x.reach == spatial::Reach::by_stop});
    return result;
  }

  /// Where things can be put; asked for when it is first needed. The things have to outlive it.
  TableReach reach_of(const std::vector<TableThing>& things) {
    return
      [this, &things, told = TableReach{}](const TableThing& thing, double x, double y) mutable {
        if (!told)
          told = ask_reach(things);
        return told(thing, x, y);
      };
  }

  /// Whether a thing can be put where another is, for requests that have both leave their places.
  TableExchange exchange() {
    return [this](const TableThing& thing, const TableThing& other) -> std::optional<std::string> {
      const auto* a = memory_.thing(thing.object);
      const auto* b = memory_.thing(other.object);
      if (a == nullptr || b == nullptr || a->is_held || b->is_held)
        return std::nullopt;
      try {
        manipulation::ExchangeQuery query;
        query.what = seen(*a);
        query.at = seen(*b);
        const auto told = call<manipulation::ExchangeQuery, manipulation::ExchangeQuery>(
          manipulation(), query, {.timeout = patience()});
        return told.is_known ? std::optional{told.reason} : std::nullopt;
      } catch (const WorkingMemoryException& e) {
        debug("{}", e.what());
        return std::nullopt;
      }
    };
  }

  /// Where the arm itself can put a thing, as if it were alone on the table.
  TableLanding landing() {
    return [this](const TableThing& thing, const std::vector<spatial::GroundPoint>& points,
                  bool may_put_between) -> std::vector<spatial::Reach> {
      const auto* known = memory_.thing(thing.object);
      if (known == nullptr || known->is_held || !known->on.empty())
        return {};
      try {
        manipulation::LandingQuery query;
        query.what = seen(*known);
        query.points = points;
        query.may_put_between = may_put_between;
        return call<manipulation::LandingQuery, manipulation::LandingQuery>(manipulation(), query,
                                                                            {.timeout = patience()})
          .reach;
      } catch (const WorkingMemoryException& e) {
        debug("{}", e.what());
        // Stops that take so long to find are none.
        return std::vector(may_put_between ? points.size() : 0, spatial::Reach::none);
      }
    };
  }

  /// Whether it is where it was to be, as far as that can be seen.
  bool is_there(const std::string& id, const std::vector<spatial::WantedPlace>& places_wanted) {
    std::vector<std::string> parts;
    std::vector<spatial::WantedPlace> wanted;
    for (auto place : places_wanted) {
      for (auto& landmark : place.landmarks)
        if (const auto* thing = memory_.thing(landmark))
          landmark = thing->seen.id;
      const bool is_seen = is_seen_part(place.relation);
      if (is_seen)
        parts.push_back(place.relation);
      if (place.relation != "on" && (!place.landmarks.empty() || is_seen))
        wanted.push_back(std::move(place));
    }
    const auto held = places(std::move(parts));
    return std::ranges::all_of(wanted, [&](const spatial::WantedPlace& x) {
      return std::ranges::any_of(held,
                                 [&](const ThingAtPlace& y) { return y.id == id && y.place == x; });
    });
  }

  /// Where it is seen, or was to be put.
  spatial::GroundPoint place_of(const std::string& id, const manipulation::TablePlace& wanted) {
    const auto& on = wanted.on.address.id;
    for (const auto& x : {id, on})
      try {
        if (!x.empty()) {
          const auto& at = read<vision::SceneObject>({vision(), x})->box.centroid;
          return {at.x, at.y};
        }
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
      }
    return {wanted.x, wanted.y};
  }

private:
  EntryPointer<vision::SceneObject> seen(const TableMemory::Thing& x) const {
    return EntryPointer<vision::SceneObject>{Address{vision(), x.seen.id}};
  }

  TableReach ask_reach(const std::vector<TableThing>& things) {
    spatial::ReachQuery query;
    std::vector<std::string> objects;
    for (const auto& x : things) {
      const auto* known = memory_.thing(x.object);
      auto at = known == nullptr || known->is_held ? std::string{} : location_of(known->seen.id);
      // What stands on another thing vision may see as one with it.
      if (known == nullptr || !known->on.empty() || (at.empty() && !known->is_held))
        continue;
      query.things.push_back({std::move(at), known->seen.height});
      objects.push_back(x.object);
    }
    return reach_told(
      call<spatial::ReachQuery, spatial::ReachQuery>(spatial(), query, {.timeout = patience()}),
      std::move(objects));
  }

  /// The location of a thing, or of what it stands on, which vision may see as one with it; empty
  /// if neither is seen.
  std::string location_seen(const std::string& name) const {
    for (const auto* x = memory_.thing(name); x != nullptr; x = memory_.thing(x->on))
      if (auto at = location_of(x->seen.id); !at.empty())
        return at;
    return {};
  }

  static manipulation::TablePlace table_place(const spatial::GroundPoint& at) {
    manipulation::TablePlace result;
    result.x = at.x;
    result.y = at.y;
    return result;
  }

  Option<std::int64_t> places_{this, "places", 10, "places that are tried for a step"};
};

} // namespace castor::planning
