#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types of the spatial working memory: locations of objects, and spatial relations between
/// them.
namespace castor::spatial {

/// Relation of a target to a landmark from the viewer's position: front is between the landmark and
/// the viewer.
enum class SpatialRelation { near, front, back, left, right };

inline constexpr SpatialRelation all_spatial_relations[] = {
  SpatialRelation::near, SpatialRelation::front, SpatialRelation::back, SpatialRelation::left,
  SpatialRelation::right};

/// A point on the plane z = 0 of a frame that the context names; metres.
struct GroundPoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const GroundPoint&, const GroundPoint&) = default;
};

/// Location of an object, or a static point such as "left of the table", which has a label and no
/// object.
struct SpatialLocation {
  EntryPointer<vision::SceneObject> object;
  geometry::AlignedBox box;
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

/// Announces a component that finds this relation in every scene. Ephemeral.
struct RelationFinder {
  SpatialRelation relation = SpatialRelation::near;
  std::string component;
};

/// All locations at one time. One component for each relation adds the pairs for which it holds;
/// the scene is complete when no component is active any more. The component that adds the scene
/// lists the active ones, so that the scene cannot seem complete before they have begun.
struct SpatialScene {
  /// Its frame is that of all locations.
  geometry::Pose viewer;
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

/// How something can be put at a point: directly, if it is put down on its way, to be held in
/// another way, perhaps, if it is not known, or not at all.
enum class Reach { direct, by_stop, perhaps, none };

/// A possible position, and how well the word fits there.
struct TargetPosition {
  GroundPoint position;
  double value = 0;
  /// Name of the frame of `position`.
  std::string frame = {};
  Reach reach = Reach::direct;

  friend bool operator==(const TargetPosition&, const TargetPosition&) = default;
};

/// A call for positions that are `relation` of a landmark. In the reply, which is of the same type,
/// `targets` may have fewer than the requested ones, or none if there is no such position.
struct SpatialRelationshipTargetQuery {
  SpatialRelation relation = SpatialRelation::near;
  /// The id of a SpatialLocation.
  std::string landmark;
  std::uint32_t requested_targets = 1;
  /// The id of a SpatialScene; empty for the latest.
  std::string scene;
  std::vector<TargetPosition> targets;
};

/// Where something is to be: in a relation to landmarks (near, left, right, front, back, between,
/// on, away), or in a part of the table (left, left-edge, front-left-corner, centre, front-middle,
/// edge, corner, elsewhere, table, strip-1-of-3).
struct WantedPlace {
  std::string relation;
  /// Ids of SpatialLocations.
  std::vector<std::string> landmarks;

  friend bool operator==(const WantedPlace&, const WantedPlace&) = default;
};

/// A call for positions on the table where something can be put. In the reply, which is of the same
/// type, `targets` may have fewer than the requested ones; if none, `reason` says why.
struct PlacementQuery {
  /// What is to be put there: the id of a SpatialLocation; empty for what is in no scene.
  std::string thing;
  /// All of them are to hold.
  std::vector<WantedPlace> places;
  std::uint32_t requested_targets = 1;
  /// The id of a SpatialScene; empty for the latest.
  std::string scene;
  std::vector<TargetPosition> targets;
  /// The location that the thing is to stand on; empty for the table.
  std::string on;
  /// A clause: "there is no room left of it".
  std::string reason;
  /// Of the disc that what is in no scene fits in, metres.
  double radius = 0.03;
  /// Of what is in no scene, metres.
  double height = 0.05;
  /// Where it is to be put from there, one or none: places where it can be held so come first.
  std::vector<GroundPoint> onward = {};
};

/// Entry: where on the table somebody, such as an arm, can take things and put them down; on a grid
/// of points, by the height of things. A thing can be put from one point to another only if there
/// is a way to hold it that will do at both.
struct ReachableTable {
  /// The point of the first column and row, and how far points are apart, metres.
  GroundPoint low;
  double step = 0.02;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  /// Of things, metres, ascending.
  std::vector<double> heights;
  /// A bit for each way to hold a thing; by heights, then rows, then columns.
  std::vector<std::uint32_t> ways;
  /// Those in which what is held now may be held.
  std::uint32_t held_ways = ~std::uint32_t{0};

  friend bool operator==(const ReachableTable&, const ReachableTable&) = default;
};

/// How a thing can be put anywhere on a table.
struct ThingReach {
  /// The id of a SpatialLocation; empty for what an arm holds.
  std::string thing;
  /// Of what is held, metres.
  double height = 0.05;
  /// In the reply: in the middle of each square of a grid, by rows, then columns.
  std::vector<Reach> squares = {};

  friend bool operator==(const ThingReach&, const ThingReach&) = default;
};

/// A call: where on the table can things be put? In the reply, which is of the same type, no thing
/// has squares if no arm has told where it reaches.
struct ReachQuery {
  std::vector<ThingReach> things;
  /// Of the reply's grid: the outer corner of the first square, and the length of a side, metres.
  GroundPoint low;
  double step = 0;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  friend bool operator==(const ReachQuery&, const ReachQuery&) = default;
};

/// Something that is where it could have been wanted.
struct HeldPlace {
  /// The id of a SpatialLocation.
  std::string thing;
  WantedPlace place;
  /// False where it is so far from a landmark that who asks for that place wants it nearer.
  bool is_close = true;

  friend bool operator==(const HeldPlace&, const HeldPlace&) = default;
};

/// A call: what is where on the table? Relations are those of PlacementQuery, so that what was put
/// at a place found by it is there. The reply is of the same type.
struct HeldPlacesQuery {
  /// Parts of the table that are asked for; relations to things are in any case.
  std::vector<std::string> parts;
  /// The id of a SpatialScene; empty for the latest.
  std::string scene;
  std::vector<HeldPlace> held;
};

CASTOR_REFLECT_ENUM(SpatialRelation, near, front, back, left, right)
CASTOR_REFLECT(GroundPoint, x, y)
CASTOR_REFLECT(SpatialLocation, object, box, label)
CASTOR_REFLECT(SpatialRelationship, relation, target, landmark, value)
CASTOR_REFLECT(RelationFinder, relation, component)
CASTOR_REFLECT(SpatialScene, viewer, time, locations, near, front, back, left, right,
               active_components)
CASTOR_REFLECT_ENUM(Reach, direct, by_stop, perhaps, none)
CASTOR_REFLECT(TargetPosition, position, value, frame, reach)
CASTOR_REFLECT(SpatialRelationshipTargetQuery, relation, landmark, requested_targets, scene,
               targets)
CASTOR_REFLECT(WantedPlace, relation, landmarks)
CASTOR_REFLECT(PlacementQuery, thing, places, requested_targets, scene, targets, on, reason, radius,
               height, onward)
CASTOR_REFLECT(ReachableTable, low, step, columns, rows, heights, ways, held_ways)
CASTOR_REFLECT(ThingReach, thing, height, squares)
CASTOR_REFLECT(ReachQuery, things, low, step, columns, rows)
CASTOR_REFLECT(HeldPlace, thing, place, is_close)
CASTOR_REFLECT(HeldPlacesQuery, parts, scene, held)

} // namespace castor::spatial
