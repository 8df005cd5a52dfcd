#include "castor/actors/component/registry.hpp"
#include "castor/perception/spatial/camera_directions.hpp"
#include "castor/perception/spatial/components/field_settings.hpp"
#include "castor/perception/spatial/scene_relations.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <string>
#include <utility>
#include <vector>

namespace castor::spatial {

namespace {

enum class RelationModel { fields, directions };
CASTOR_REFLECT_ENUM(RelationModel, fields, directions)

/// Finds all pairs of locations in a scene that one relation holds for. One component for each
/// relation, all of them at once; a scene is complete when none of them is at work on it.
class SpatialRelater final : public UnmanagedComponent {
  void configure() override {
    thresholds_.projective = thresholds_.proximity =
      threshold_ > 0 ? threshold_ : RelationThresholds{}.of(relation_);
  }

  void start() override {
    add(RelationFinder{relation_, component_name()}, {.ephemeral = true});
    on_change(added<SpatialScene>(), [this](const ChangeEvent& event) { relate(event.address); });
    // What a predecessor did not get to, or did in a way that may have been another.
    for (auto& x : read_all<SpatialScene>(1))
      relate(x.address);
  }

  void relate(const Address& address) {
    try {
      auto found = relations_in(*read<SpatialScene>(address));
      // All relaters write to the same scene.
      auto guard = lock(address, LockLevel::odr);
      auto scene = *read<SpatialScene>(address);
      list_of(scene, relation_) = std::move(found);
      std::erase(scene.active_components, component_name());
      overwrite(address, std::move(scene));
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  std::vector<SpatialRelationship> relations_in(const SpatialScene& scene) {
    std::vector<ScenePlace> places;
    for (auto& id : scene.locations)
      try {
        places.push_back({id, ground_point(read<SpatialLocation>(here(id))->box)});
      } catch (const DoesNotExistOnWM&) {
        debug("{} is gone", id);
      }
    if (model_ == RelationModel::directions)
      return by_direction(places, scene.viewer);
    return relationships(relation_, places, {scene.viewer.position.x, scene.viewer.position.y},
                         settings_.options(), thresholds_);
  }

  std::vector<SpatialRelationship> by_direction(const std::vector<ScenePlace>& places,
                                                const geometry::Pose& viewer) {
    std::vector<SpatialRelationship> result;
    auto directions = ground_directions(viewer);
    if (!directions || relation_ == SpatialRelation::near)
      return result;
    for (auto& target : places)
      for (auto& landmark : places)
        if (&target != &landmark &&
            is_on_side(*directions, relation_, target.position, landmark.position, margin_))
          result.push_back({relation_, target.location, landmark.location, 1});
    return result;
  }

  Option<SpatialRelation> relation_{this, "relation", SpatialRelation::near, "which relation"};
  Option<RelationModel> model_{
    this, "model", RelationModel::fields,
    "potential fields with distance and distractors, or directions only, as in CLEVR"};
  Option<double> threshold_{this, "threshold", 0,
                            "least value at which it holds; 0 for 0.95 (near) or 0.8"};
  Option<double> margin_{this, "margin", 0, "for directions: least distance to that side, metres"};
  FieldSettings settings_{this};

  RelationThresholds thresholds_;
};

CASTOR_COMPONENT(SpatialRelater, "finds the pairs of locations that a spatial relation holds for")

} // namespace

} // namespace castor::spatial
