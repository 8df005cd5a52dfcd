#pragma once

#include "castor/mapping/localisation/distance_field.hpp"
#include "castor/mapping/localisation/map_fit.hpp"
#include "castor/mapping/localisation/place_search.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace castor::mapping {

struct PlaceTrackerOptions {
  PlaceSearchOptions search;
  /// Scans so far apart, m plus radians, that the map is searched by, and how many.
  double trail_spacing = 0.4;
  std::size_t trail_length = 8;
  /// The map is searched again after so much way, m plus radians, while there are no places or too
  /// many, and while there are some.
  double search_soon = 0.5;
  double search_again = 2;
  /// While there are none, it is searched again after so long, too, s.
  double still_period = 5;
  /// What a place explains is the mean over about so many scans.
  double memory = 12;
  /// A place that explains less is none, nor one that explains so much less than the best.
  double least_explained = 0.55;
  double margin = 0.15;
  /// Deviations of the odometry from scan to scan, m and radians.
  double step_deviation = 0.05;
  double step_deviation_heading = 0.05;
};

/// All places in a map at which a robot may be, by its scans so far: searched for in the whole map,
/// and followed while the robot moves until they do not explain its scans any more. So it is known
/// whether there is another place that looks like the one where the robot seems to be. Without
/// threads and clocks.
class PlaceTracker {
public:
  PlaceTracker(std::shared_ptr<const DistanceField> map, const MapFitOptions& fit,
               const PlaceTrackerOptions& options = {});

  /// Forgets all; the next scan is the first.
  void restart();

  /// The next scan. Returns whether the map was searched.
  /// @param odometry of the robot at its time
  bool add(const LaserScan& scan, const Pose2& odometry);

  /// The one that explains most first; empty if there are none or too many.
  const std::vector<Place>& places() const { return places_; }

  /// There are so many places that they are not followed one by one.
  bool too_many() const { return too_many_; }

  /// How many other places look like the one at that pose: all of them if there is none.
  std::size_t rivals(const Pose2& pose) const;

private:
  struct Passed {
    LaserScan scan;
    Pose2 odometry;
  };

  void follow(const LaserScan& scan, const Pose2& motion);
  void search(std::int64_t time, const Pose2& odometry);

  PlaceTrackerOptions options_;
  std::shared_ptr<const DistanceField> map_;
  MapFit fit_;
  PlaceSearch search_;
  std::deque<Passed> trail_;
  std::vector<Place> places_;
  bool too_many_ = false;
  bool has_begun_ = false;
  Pose2 odometry_;
  double way_since_trail_ = 0;
  double way_since_search_ = 0;
  /// Time of the scan that was searched by, microseconds.
  std::int64_t searched_ = 0;
};

} // namespace castor::mapping
