#pragma once

#include "castor/mapping/localisation/distance_field.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <memory>
#include <utility>

namespace castor::mapping {

struct MapFitOptions {
  /// A beam is explained if it ends so near to an occupied cell that can be seen, m ...
  double near = 0.2;
  /// ... and passes none before that. A cell that is that near to the end does not count, since the
  /// pose is not exact.
  double before_end = 0.4;
  /// How many beams of a scan are looked at, at most.
  std::size_t beams = 90;
};

/// Tells how much of a scan a map explains.
class MapFit {
public:
  explicit MapFit(std::shared_ptr<const DistanceField> map, const MapFitOptions& options = {})
    : options_(options), map_(std::move(map)) {}

  /// Share of the scan's beams that the map explains if the robot is there, from 0 to 1; 1 for a
  /// scan in which nothing came back.
  double explained(const LaserScan& scan, const Pose2& robot) const;

private:
  bool is_explained(const Pose2& scanner, double angle, double range) const;

  MapFitOptions options_;
  std::shared_ptr<const DistanceField> map_;
};

} // namespace castor::mapping
