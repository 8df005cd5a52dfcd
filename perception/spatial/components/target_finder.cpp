#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/perception/spatial/components/field_settings.hpp"
#include "castor/perception/spatial/reach.hpp"
#include "castor/perception/spatial/scene_relations.hpp"
#include "castor/perception/spatial/table_places.hpp"
#include "castor/perception/spatial/types.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::spatial {

namespace {

/// The disc that a box fits in, from above. Boxes do not tell what is round on top.
TableObject table_object(const geometry::AlignedBox& box) {
  return {ground_point(box), std::hypot(box.size.x, box.size.y) / 2 / std::sqrt(2.0), true,
          box.centroid.z - box.size.z / 2, box.centroid.z + box.size.z / 2};
}

/// Answers where something could be put: calls with a SpatialRelationshipTargetQuery or with a
/// PlacementQuery; and what is where.
class TargetFinder final : public UnmanagedComponent {
  void start() override {
    on_call<SpatialRelationshipTargetQuery>(
      [this](const SpatialRelationshipTargetQuery& x) { return find(x); });
    on_call<PlacementQuery>([this](const PlacementQuery& x) { return place(x); });
    on_call<HeldPlacesQuery>([this](const HeldPlacesQuery& x) { return look(x); });
    on_call<ReachQuery>([this](const ReachQuery& x) { return tell_reach(x); });
  }

  SpatialRelationshipTargetQuery find(SpatialRelationshipTargetQuery query) {
    auto scene = scene_of(query);
    std::vector<GroundPoint> objects;
    std::size_t landmark = scene.locations.size();
    for (std::size_t i = 0; i < scene.locations.size(); ++i) {
      if (scene.locations[i] == query.landmark)
        landmark = i;
      objects.push_back(ground_point(read<SpatialLocation>(here(scene.locations[i]))->box));
    }
    if (landmark == scene.locations.size())
      throw std::invalid_argument("there is no location " + query.landmark + " in the scene");
    PotentialFields fields{
      objects, {scene.viewer.position.x, scene.viewer.position.y}, settings_.options()};
    query.targets = fields.positions(query.relation, landmark, query.requested_targets);
    for (auto& target : query.targets)
      target.frame = scene.viewer.frame;
    return query;
  }

  PlacementQuery place(PlacementQuery query) {
    const auto scene = scene_of(query);
    auto objects = objects_of(scene);
    const auto index_of = [&](const std::string& id) {
      const auto found = std::ranges::find(scene.locations, id);
      if (found == scene.locations.end())
        throw std::invalid_argument("there is no location " + id + " in the scene");
      return static_cast<std::size_t>(found - scene.locations.begin());
    };
    std::vector<PlaceWanted> places;
    for (const auto& x : query.places) {
      auto& wanted = places.emplace_back(PlaceWanted{x.relation, {}});
      for (const auto& id : x.landmarks)
        wanted.landmarks.push_back(index_of(id));
    }
    const auto thing = query.thing.empty() ? objects.size() : index_of(query.thing);
    auto options = placing_options();
    if (const auto reach = reachable_table()) {
      options.reach = [x = reach_of(*reach, query.thing, query.height),
                       onward = query.onward](const GroundPoint& at) {
        return onward.empty() ? x.at(at) : x.at_and_onward(at, onward.front());
      };
      // The arm finds out whether there is room for its hand.
      options.least_clearance = 0.005;
    }
    // In the way of nothing.
    constexpr GroundPoint far_away{100, 100};
    if (thing == objects.size())
      objects.push_back({far_away, query.radius, true});
    const auto found = table(scene, objects, options).find(thing, places, query.requested_targets);
    query.targets = found.targets;
    for (auto& target : query.targets)
      target.frame = scene.viewer.frame;
    query.on = found.on ? scene.locations[*found.on] : std::string{};
    query.reason = found.reason;
    return query;
  }

  ReachQuery tell_reach(ReachQuery query) {
    const auto reach = reachable_table();
    if (!reach || reach->columns < 2 || reach->rows < 2)
      return query;
    query.low = reach->low;
    query.step = reach->step;
    query.columns = reach->columns - 1;
    query.rows = reach->rows - 1;
    for (auto& x : query.things)
      x.squares = reach_of(*reach, x.thing, x.height).on_squares();
    return query;
  }

  /// Nothing if there is no arm, or it has not told it yet.
  std::optional<ReachableTable> reachable_table() {
    if (reach_->empty())
      return std::nullopt;
    const auto told = read_all_in<ReachableTable>(reach_.get(), 1);
    return told.empty() ? std::nullopt : std::optional{*told.front()};
  }

  /// How the arm can put the thing somewhere, which it takes from where it is or holds.
  /// @param location of the thing; empty for what is held. @param height of that
  ReachOfThing reach_of(const ReachableTable& reach, const std::string& location, double height) {
    if (location.empty())
      return {reach, height, reach.held_ways};
    const auto box = read<SpatialLocation>(here(location))->box;
    const auto ways = ways_at(reach, ground_point(box), box.size.z);
    // What is seen beyond the arm's reach may be within.
    return {reach, box.size.z, ways == 0 ? ~ways : ways};
  }

  HeldPlacesQuery look(HeldPlacesQuery query) {
    const auto scene = scene_of(query);
    query.held.clear();
    for (const auto& x : table(scene, objects_of(scene), placing_options()).all_held(query.parts)) {
      auto& held = query.held.emplace_back(
        HeldPlace{scene.locations[x.object], {x.place.relation, {}}, x.is_close});
      for (const auto i : x.place.landmarks)
        held.place.landmarks.push_back(scene.locations[i]);
    }
    return query;
  }

  std::vector<TableObject> objects_of(const SpatialScene& scene) {
    std::vector<TableObject> result;
    for (const auto& id : scene.locations)
      result.push_back(table_object(read<SpatialLocation>(here(id))->box));
    return result;
  }

  PlacingOptions placing_options() const {
    PlacingOptions result;
    result.area = {{-width_ / 2, -depth_ / 2}, {width_ / 2, depth_ / 2}};
    result.clearance = clearance_;
    return result;
  }

  static TablePlaces table(const SpatialScene& scene, const std::vector<TableObject>& objects,
                           const PlacingOptions& options) {
    return TablePlaces{objects, {scene.viewer.position.x, scene.viewer.position.y}, options};
  }

  /// The latest scene, if the query names none.
  template <class Query>
  SpatialScene scene_of(const Query& query) {
    if (!query.scene.empty())
      return *read<SpatialScene>(here(query.scene));
    auto latest = read_all<SpatialScene>(1);
    if (latest.empty())
      throw std::runtime_error("there is no scene yet");
    return *latest.front();
  }

  FieldSettings settings_{this};
  Option<double> width_{this, "table-width", 0.60, "where things may be put, metres"};
  Option<double> depth_{this, "table-depth", 0.52, "where things may be put, metres"};
  Option<double> clearance_{this, "clearance", PlacingOptions{}.clearance,
                            "between things that are put somewhere and others, metres"};
  Option<SubarchitectureName> reach_{
    this, "reach", "",
    "the subarchitecture with the ReachableTable of an arm, where things are put; empty: anywhere"};
};

CASTOR_COMPONENT(TargetFinder, "finds positions that are left of, near ... a landmark")

} // namespace

} // namespace castor::spatial
