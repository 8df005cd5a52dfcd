#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/perception/spatial/components/field_settings.hpp"
#include "castor/perception/spatial/scene_relations.hpp"
#include "castor/perception/spatial/types.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace castor::spatial {

namespace {

/// Answers where something could be put: calls with a SpatialRelationshipTargetQuery.
class TargetFinder final : public UnmanagedComponent {
  void start() override {
    on_call<SpatialRelationshipTargetQuery>(
      [this](const SpatialRelationshipTargetQuery& x) { return find(x); });
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

  SpatialScene scene_of(const SpatialRelationshipTargetQuery& query) {
    if (!query.scene.empty())
      return *read<SpatialScene>(here(query.scene));
    auto latest = read_all<SpatialScene>(1);
    if (latest.empty())
      throw std::runtime_error("there is no scene yet");
    return *latest.front();
  }

  FieldSettings settings_{this};
};

CASTOR_COMPONENT(TargetFinder, "finds positions that are left of, near ... a landmark")

} // namespace

} // namespace castor::spatial
