#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types of the spatial working memory: where things are, and how they lie to each other.
namespace castor::spatial {

/// How a target lies to a landmark, as the viewer sees it: front is between the landmark and the
/// viewer.
enum class SpatialRelation { near, front, back, left, right };

inline constexpr SpatialRelation all_spatial_relations[] = {
  SpatialRelation::near, SpatialRelation::front, SpatialRelation::back, SpatialRelation::left,
  SpatialRelation::right};

/// A point on the table; metres.
struct GroundPoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const GroundPoint&, const GroundPoint&) = default;
};

/// Where an object is, or a static point such as "left of the table", which has a label and no
/// object.
struct SpatialLocation {
  EntryPointer<vision::SceneObject> object;
  vision::ObjectBox box;
  std::string label;
};

/// `target` is `relation` of `landmark`; both are ids of SpatialLocation entries.
struct SpatialRelationship {
  SpatialRelation relation = SpatialRelation::near;
  std::string target;
  std::string landmark;
  /// How well the word fits, in [0, 1].
  double value = 0;

  friend bool operator==(const SpatialRelationship&, const SpatialRelationship&) = default;
};

/// There is a component that finds this relation in every scene. Goes with that component.
struct RelationFinder {
  SpatialRelation relation = SpatialRelation::near;
  std::string component;
};

/// All locations at one time. One component for each relation fills in what holds; the scene is
/// complete when no component is active any more. Whoever makes the scene writes down who is to be
/// active, so that it cannot seem complete before they have begun.
struct SpatialScene {
  vision::Pose viewer;
  /// Microseconds since the system began.
  std::int64_t time = 0;
  /// Ids of SpatialLocation entries.
  std::vector<std::string> locations;
  std::vector<SpatialRelationship> near;
  std::vector<SpatialRelationship> front;
  std::vector<SpatialRelationship> back;
  std::vector<SpatialRelationship> left;
  std::vector<SpatialRelationship> right;
  std::vector<std::string> active_components;
};

/// Where something could be put, and how well the word fits there.
struct TargetPosition {
  GroundPoint position;
  double value = 0;

  friend bool operator==(const TargetPosition&, const TargetPosition&) = default;
};

/// A call: which positions are `relation` of a landmark? In the reply, which is of the same type,
/// `targets` may hold fewer than were asked for, or none: there is no such position.
struct SpatialRelationshipTargetQuery {
  SpatialRelation relation = SpatialRelation::near;
  /// The id of a SpatialLocation.
  std::string landmark;
  std::uint32_t requested_targets = 1;
  /// The id of a SpatialScene; empty for the latest.
  std::string scene;
  std::vector<TargetPosition> targets;
};

CASTOR_REFLECT_ENUM(SpatialRelation, near, front, back, left, right)
CASTOR_REFLECT(GroundPoint, x, y)
CASTOR_REFLECT(SpatialLocation, object, box, label)
CASTOR_REFLECT(SpatialRelationship, relation, target, landmark, value)
CASTOR_REFLECT(RelationFinder, relation, component)
CASTOR_REFLECT(SpatialScene, viewer, time, locations, near, front, back, left, right,
               active_components)
CASTOR_REFLECT(TargetPosition, position, value)
CASTOR_REFLECT(SpatialRelationshipTargetQuery, relation, landmark, requested_targets, scene,
               targets)

} // namespace castor::spatial
