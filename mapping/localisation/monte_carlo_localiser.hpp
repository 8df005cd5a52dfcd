#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/localisation/distance_field.hpp"
#include "castor/mapping/localisation/localisation_monitor.hpp"
#include "castor/mapping/localisation/map_alignment.hpp"
#include "castor/mapping/localisation/map_fit.hpp"
#include "castor/mapping/localisation/particle_filter.hpp"
#include "castor/mapping/localisation/particles.hpp"
#include "castor/mapping/localisation/place_tracker.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace castor::mapping {

struct MonteCarloOptions {
  ParticleFilterOptions filter;
  ClusterOptions clusters;
  MapFitOptions fit;
  LocalisationMonitorOptions monitor;
  PlaceTrackerOptions places;
  /// Of the pose that is told, near that of the particles.
  MapAlignmentOptions alignment{.prior = 0.15, .prior_heading = 0.05};
  std::size_t alignment_beams = 90;
  /// Particles for a square metre of free space when the robot may be at more places than can be
  /// followed one by one; as many as the filter may have, at most.
  double search_density = 120;
  /// Deviations of a start that is given, m and radians.
  double start_deviation = 0.2;
  double start_deviation_heading = 0.1;
  /// Particles are weighted when the robot has moved so far, m, or turned, radians, ...
  double update_distance = 0.1;
  double update_turn = 0.1;
  /// ... and, while a robot that stands is not found yet, after so long, s, so many times, and as
  /// often as places are searched for then: its scans tell little new.
  double still_period = 0.3;
  std::size_t still_updates = 10;
};

struct LocalisationStep {
  std::int64_t time = 0;
  /// Of the robot in the map: where it most probably is.
  Pose2 pose;
  PoseCovariance covariance;
  /// Deviation of the position, m.
  double spread = 0;
  /// Share of the beams that the map explains from there.
  double explained = 0;
  /// In how many places the robot may be, and how probable the first is.
  std::size_t clusters = 0;
  double weight = 0;
  /// While the robot is searched for: other places that explain its scans as well.
  std::size_t rivals = 0;
  std::size_t particles = 0;
  LocalisationState state = LocalisationState::starting;
  /// For people, where the state is not tracking, or has become it.
  std::string reason;
};

/// Where a robot is in a given map, scan by scan: from a start that is known or not. Notices that
/// it is lost, and searches the whole map then. A search is systematic: all places that explain the
/// scans get particles, and the robot is found when one of them is left. Without threads and
/// clocks.
class MonteCarloLocaliser {
public:
  /// @param start pose of the robot at its first scan; nothing if it may be anywhere
  /// @throws std::invalid_argument if the map is turned, or has no free or no occupied cell
  MonteCarloLocaliser(const CellMap& map, const std::optional<Pose2>& start,
                      const MonteCarloOptions& options = {});

  /// The next scan, with the robot's odometry at its time.
  LocalisationStep add(const LaserScan& scan, const Pose2& odometry);

private:
  bool is_due(std::int64_t time, const Pose2& motion);
  bool is_searching() const;
  void search_everywhere();
  void update(const LaserScan& scan, const Pose2& odometry, const Pose2& motion);
  void summarise();

  MonteCarloOptions options_;
  std::shared_ptr<const DistanceField> map_;
  MapFit fit_;
  ParticleFilter filter_;
  PlaceTracker places_;
  LocalisationMonitor monitor_;
  bool has_begun_ = false;
  /// The robot may be anywhere, so that other places count.
  bool is_anywhere_ = false;
  /// There are particles.
  bool is_spread_ = false;
  /// Of the last update.
  std::int64_t updated_ = 0;
  Pose2 update_odometry_;
  std::size_t still_updates_ = 0;
  Pose2 last_odometry_;
  ParticleCluster best_;
  std::size_t clusters_ = 0;
  std::size_t particles_ = 0;
};

} // namespace castor::mapping
