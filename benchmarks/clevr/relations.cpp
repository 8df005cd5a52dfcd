#include "castor/benchmarks/clevr/relations.hpp"

#include <stdexcept>
#include <utility>

#include "castor/perception/spatial/camera_directions.hpp"

namespace castor::clevr {

namespace {

using spatial::GroundPoint;
using spatial::SpatialRelation;

constexpr std::pair<const char*, SpatialRelation> words[] = {{"left", SpatialRelation::left},
                                                             {"right", SpatialRelation::right},
                                                             {"front", SpatialRelation::front},
                                                             {"behind", SpatialRelation::back}};

struct Found {
  std::size_t object = 0;
  GroundPoint seen;
};

std::vector<Found> found_objects(const Outcome& outcome) {
  std::vector<Found> result;
  for (const auto& match : outcome.matches) {
    const auto& place = outcome.regions[match.region].roi.features.extent.centroid;
    result.push_back({match.object, {place.x, place.y}});
  }
  return result;
}

} // namespace

RelationSummary judge_relations(const std::vector<Outcome>& outcomes,
                                const geometry::Camera& camera) {
  const auto directions = spatial::ground_directions(camera.pose);
  if (!directions)
    throw std::invalid_argument("the camera looks straight down: there is no left and right");
  RelationSummary summary;
  for (const auto& outcome : outcomes) {
    const Scene& scene = *outcome.scene;
    const auto objects = found_objects(outcome);
    summary.objects += objects.size();
    summary.pairs += objects.size() * (objects.size() - 1);
    for (const auto& [word, relation] : words) {
      const auto truth = scene.relations.find(word);
      if (truth == scene.relations.end())
        continue;
      for (const auto& target : objects) {
        for (const auto& landmark : objects) {
          if (target.object == landmark.object)
            continue;
          const bool said = is_on_side(*directions, relation, target.seen, landmark.seen,
                                       relation_margin * metres_per_unit);
          const bool holds = truth->second.contains({landmark.object, target.object});
          summary.words[word].add(said == holds);
          summary.all.add(said == holds);
          if (holds)
            summary.recall.add(said);
          if (said)
            summary.precision.add(holds);
          if (said == holds)
            continue;
          const auto& there = scene.objects[target.object].position;
          const auto& here = scene.objects[landmark.object].position;
          summary.mistakes.push_back(
            {&scene, target.object, landmark.object, word,
             distance_to_side(*directions, relation, target.seen, landmark.seen) / metres_per_unit,
             distance_to_side(*directions, relation, {there.x, there.y}, {here.x, here.y})});
        }
      }
    }
  }
  return summary;
}

} // namespace castor::clevr
