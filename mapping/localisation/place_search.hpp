#pragma once

#include "castor/mapping/localisation/distance_field.hpp"
#include "castor/mapping/localisation/map_alignment.hpp"
#include "castor/mapping/localisation/map_fit.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace castor::mapping {

/// A scan on the way of a robot.
struct PlacedScan {
  LaserScan scan;
  /// Of the robot then, as seen from where it is now.
  Pose2 pose;
};

/// A pose in a map at which a robot may be.
struct Place {
  Pose2 pose;
  /// Share of the beams that the map explains from there.
  double explained = 0;
};

struct PlaceSearchOptions {
  /// Poses of the grid that is searched are so far apart, m and radians. Each that may fit is
  /// looked at in half steps, and those that fit better than their neighbours are aligned.
  double step = 0.2;
  double step_heading = 0.105;
  /// The robot is at least so far from occupied cells, m.
  double clearance = 0.15;
  /// Beams that the grid is searched by.
  std::size_t points = 60;
  /// A beam's end is near an occupied cell within this, m, and what a step moves it by.
  double near = 0.1;
  /// Poses that explain less are no places, nor those that explain so much less than the best.
  double least_explained = 0.6;
  double margin = 0.25;
  /// Places that are nearer in position, m, and in heading, radians, are one.
  double apart = 0.3;
  double apart_heading = 0.3;
  /// Poses that may fit, and places, that are looked at.
  std::size_t most_candidates = 20000;
  std::size_t most_places = 300;
};

struct FoundPlaces {
  /// The one that explains most first.
  std::vector<Place> places;
  /// There are more places than one looks at; `places` is empty.
  bool too_many = false;
};

/// Finds all poses in a map that explain scans.
class PlaceSearch {
public:
  PlaceSearch(std::shared_ptr<const DistanceField> map, const MapFitOptions& fit,
              const PlaceSearchOptions& options = {});

  /// @param trail at least one scan, the newest last, whose pose is zero
  FoundPlaces find(const std::vector<PlacedScan>& trail) const;

  /// Mean over the scans of what the map explains if the robot is there now.
  double explained(const std::vector<PlacedScan>& trail, const Pose2& robot) const;

private:
  /// A pose of the grid, moved by half steps, that may fit.
  struct Candidate {
    Pose2 pose;
    /// Points that fit there.
    std::size_t fitting = 0;
    /// Of its position on the grid, and of its heading there.
    std::size_t position = 0;
    int heading = 0;
  };

  int headings() const;
  std::vector<Candidate> candidates(const std::vector<Point2>& points) const;
  /// Those of which no neighbour on the grid fits better.
  std::vector<Candidate> best_of_neighbours(const std::vector<Candidate>& all) const;

  PlaceSearchOptions options_;
  std::shared_ptr<const DistanceField> map_;
  MapFit fit_;
  /// Where the robot may be on the grid.
  std::vector<Point2> positions_;
};

/// Leaves only the most explained of places that are one, sorted by how much they explain.
std::vector<Place> distinct_places(std::vector<Place> places, double apart, double apart_heading);

} // namespace castor::mapping
