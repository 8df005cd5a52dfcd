#pragma once

#include "castor/perception/spatial/potential_fields.hpp"
#include "castor/perception/spatial/table_parts.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::spatial {

/// Something that stands on a table, from above; metres.
struct TableObject {
  GroundPoint centre;
  /// Of the disc that it fits in.
  double radius = 0.03;
  /// Whether something can stand on it.
  bool is_flat = true;
  /// Of its lower and upper side, above the table.
  double bottom = 0;
  double top = 0;
};

/// As WantedPlace, with indices of objects as landmarks.
struct PlaceWanted {
  std::string relation;
  std::vector<std::size_t> landmarks;
};

/// Where an object is.
struct PlaceHeld {
  std::size_t object = 0;
  PlaceWanted place;
  /// It is so near to its landmarks that nobody who asks for that place would have it nearer.
  bool is_close = true;
};

struct PlacingOptions {
  TableArea area;
  /// Between things on the table, metres.
  double clearance = 0.02;
  /// Places with less, but so much, are the last, metres; none, if it is not less.
  double least_clearance = 0.02;
  /// More than that is better, up to here: room for a hand, metres.
  double ample_clearance = 0.06;
  /// Between the positions that are looked at, at most, metres.
  double step = 0.01;
  /// Between positions that are found, metres: hands find out that some are not possible.
  double close = 0.03;
  /// Between those of them that come first, metres, of the ones that are likely possible.
  double likely_apart = 0.05;
  /// Gap up to which something is near a landmark, metres.
  double near_gap = 0.08;
  /// Gap to a landmark that places beside it, such as left of it, are no farther than, if possible,
  /// metres.
  double beside_gap = 0.05;
  /// Gaps up to which what is near a landmark, or on a side of it, is clearly so and need not be
  /// brought nearer, metres.
  double clearly_near_gap = 0.06;
  double clearly_beside_gap = 0.085;
  /// Fit to a side from which on it is clearly on it: up to some 25 degrees off.
  double clear_side_fit = 0.4;
  /// Where things are put is so far inside of what is wanted, if possible, metres: hands and eyes
  /// are not exact.
  double inaccuracy = 0.015;
  /// How the object that is to be put somewhere can be put at a point; directly, if not set. Places
  /// are the later the less likely they are possible.
  std::function<Reach(const GroundPoint&)> reach = {};
};

/// Places found, the best first, or the reason why there are none.
struct PlacesFound {
  std::vector<TargetPosition> targets;
  /// What the thing is to stand on; nothing for the table.
  std::optional<std::size_t> on;
  /// A clause; empty if there are targets.
  std::string reason;
};

/// Finds where on a table something can be put, so that it is in a relation to others. Directions
/// are those of potential fields (Kelleher and Costello 2006) without distractors - another thing
/// only takes the room that it stands on - and those of the table as well.
class TablePlaces {
public:
  TablePlaces(std::span<const TableObject> objects, GroundPoint viewer,
              PlacingOptions options = {});

  /// How well an object would be at a place if its centre were at a point, in [0, 1]; 0 if it would
  /// not be there.
  /// \throws std::invalid_argument for an unknown relation
  double fit(const PlaceWanted& place, std::size_t object, const GroundPoint& centre) const;

  /// Whether it is there now.
  bool holds(const PlaceWanted& place, std::size_t object) const {
    return fit(place, object, objects_.at(object).centre) > 0;
  }

  /// Where all objects are: in relations to one or two others, and in some parts of the table.
  std::vector<PlaceHeld> all_held(std::span<const std::string> parts) const;

  /// Positions for an object where all places fit, nothing else stands, and it can be put, apart
  /// from each other.
  PlacesFound find(std::size_t object, std::span<const PlaceWanted> places,
                   std::size_t count = 1) const;

private:
  Reach reach_of(const GroundPoint& centre) const;
  double fit_to_landmark(const PlaceWanted& place, std::size_t object,
                         const GroundPoint& centre) const;
  double side_fit(SpatialRelation way, const GroundPoint& centre,
                  const GroundPoint& landmark) const;
  double nearness(std::size_t object, const GroundPoint& centre, std::size_t landmark) const;
  double between(const PlaceWanted& place, const GroundPoint& centre) const;
  double gap_to(std::size_t object, const GroundPoint& centre, std::size_t landmark) const;
  double gap_to_landmarks(const PlaceWanted& place, std::size_t object,
                          const GroundPoint& centre) const;
  bool is_close(const PlaceWanted& place, std::size_t object) const;
  double far_off(std::span<const PlaceWanted> places, std::size_t object,
                 const GroundPoint& centre) const;
  double least_gap(std::size_t object, const GroundPoint& centre) const;
  double worst_fit(std::span<const PlaceWanted> places, std::size_t object,
                   const GroundPoint& centre) const;
  double off_side(std::span<const PlaceWanted> places, const GroundPoint& from,
                  const GroundPoint& centre) const;
  bool fits_around(std::span<const PlaceWanted> places, std::size_t object,
                   const GroundPoint& centre) const;
  PlacesFound on_top(std::size_t object, std::span<const PlaceWanted> places) const;

  std::vector<TableObject> objects_;
  PlacingOptions options_;
  GroundPoint viewer_;
};

} // namespace castor::spatial
