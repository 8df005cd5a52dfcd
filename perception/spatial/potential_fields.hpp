#pragma once

#include "castor/perception/spatial/types.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::spatial {

/// The map that fields are computed on, and radii; metres.
struct FieldOptions {
  /// The middle of the map on the table.
  GroundPoint centre;
  double map_size = 2.0;
  double cell_size = 0.01;
  /// Within this distance of another object, the fields left, right, front and back are 0; also the
  /// minimum distance between positions that are found.
  double distractor_radius = 0.15;
  /// A place is near a landmark only if it is nearer to it than to any other by this margin.
  double proximity_gate = 0.009;
};

/// Metres.
double distance(const GroundPoint& a, const GroundPoint& b);

/// How well a point is in the direction of a landmark that the word names, whatever the distance: 1
/// straight in that direction, 0.5 at half a right angle, 0 at a right angle, and at the landmark.
double angle_fit(SpatialRelation direction, const GroundPoint& point, const GroundPoint& landmark,
                 const GroundPoint& viewer);

/// Minimum value for which a relation holds.
struct RelationThresholds {
  double projective = 0.8;
  double proximity = 0.95;

  double of(SpatialRelation relation) const {
    return relation == SpatialRelation::near ? proximity : projective;
  }
};

/// Spatial relations between the objects of one scene, by the potential fields of Kelleher and
/// Costello (ACL 2006) as the PlayMate computed them: on a map of cells, each word is a field
/// around its landmark with its maximum scaled to 1.
///
/// With d the distance from the landmark, d_max that to the farthest cell of the map, and theta the
/// angle to the direction that the word names, in quarter turns:
///
///   left, right, front, back   (1 - theta) (1 - d / d_max), 0 within the distractor radius of any
///                              object besides target and landmark
///   near                       (1 - d / d_max)^2, 0 where another object is (almost) as near
///
/// The field is computed for single cells on demand, without filling a map: its maximum is 1 at the
/// landmark, unless a distractor covers that; then the maximum is searched for around it. Positions
/// are rounded to cells: moving something by less than a cell may change a value by some 0.02.
/// Objects outside of the map have no relations and are no distractors.
class PotentialFields {
public:
  /// \throws std::invalid_argument if the map has no cells.
  PotentialFields(std::span<const GroundPoint> objects, GroundPoint viewer,
                  FieldOptions options = {});

  /// How well "target is `relation` of landmark" fits, in [0, 1]. Both are indices of objects; 0 if
  /// they are the same.
  double value(SpatialRelation relation, std::size_t target, std::size_t landmark) const;

  /// Positions that are `relation` of the landmark: up to `count`, the best first, apart from each
  /// other and from all objects. Fewer if there are no more.
  std::vector<TargetPosition> positions(SpatialRelation relation, std::size_t landmark,
                                        std::size_t count) const;

  /// The best position, if there is one.
  std::optional<TargetPosition> position(SpatialRelation relation, std::size_t landmark) const;

private:
  /// Column and row.
  struct Cell {
    int x = 0;
    int y = 0;

    friend bool operator==(const Cell&, const Cell&) = default;
  };

  struct Object {
    Cell cell;
    bool on_map = false;
    /// Distance to the farthest cell of the map; cells.
    double farthest = 0;
  };

  /// A field around a landmark: the shape of a word, minus the effects of other objects; not yet
  /// scaled.
  struct Field {
    SpatialRelation relation;
    const Object* landmark = nullptr;
    /// The direction that the word names.
    GroundPoint axis;
    std::vector<const Object*> others;
  };

  Object place(const GroundPoint& point) const;
  GroundPoint middle_of(const Cell& cell) const;
  Field field(SpatialRelation relation, std::size_t landmark,
              std::optional<std::size_t> target) const;
  double linear(const Object& origin, const Cell& cell) const;
  bool within_radius(const Cell& a, const Cell& b) const;
  double angular(const Field& field, const Cell& cell) const;
  double raw_value(const Field& field, const Cell& cell) const;
  double maximum(const Field& field) const;

  FieldOptions options_;
  GroundPoint viewer_;
  /// Cells along each side of the map.
  int side_ = 0;
  std::vector<Object> objects_;
};

} // namespace castor::spatial
