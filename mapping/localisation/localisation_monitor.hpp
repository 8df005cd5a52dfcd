#pragma once

#include "castor/mapping/slam/types.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace castor::mapping {

struct LocalisationMonitorOptions {
  /// The robot is found if one cluster of particles has this probability, deviates less than that,
  /// m, the map explains this share of the beams from there, and no other place looks like it ...
  double sure_weight = 0.95;
  double sure_spread = 0.3;
  double sure_explained = 0.85;
  /// ... after it has moved that far since the search began, m plus radians ...
  double sure_way = 1;
  /// ... or, for one that stands, after so many updates and with this share of the beams.
  std::size_t still_updates = 5;
  double still_explained = 0.9;
  /// A scan of which the map explains less does not fit.
  double least_explained = 0.6;
  /// The robot is lost if no scan has fitted for so long, s.
  double lost_after = 1;
  /// Of a robot that was found, the pose is not certain if its cluster has less probability or
  /// deviates more.
  double least_weight = 0.8;
  double most_spread = 0.6;
};

/// What particles and map say of one scan.
struct LocalisationEvidence {
  /// Of the scan, us.
  std::int64_t time = 0;
  /// How many clusters there are; probability and deviation (m) of the first.
  std::size_t clusters = 0;
  double weight = 0;
  double spread = 0;
  /// Share of the beams that the map explains from the middle of the first cluster.
  double explained = 0;
  /// Other places that explain the scans as well; there may be too many to be counted.
  std::size_t rivals = 0;
  bool many_rivals = false;
  /// Way of the robot since the scan before by odometry, m plus radians.
  double moved = 0;
  /// Particles were weighted by this scan.
  bool is_update = false;
};

struct LocalisationVerdict {
  LocalisationState state = LocalisationState::starting;
  /// For people, where the state is not tracking, or has become it.
  std::string reason;
  /// The robot has to be looked for in the whole map again.
  bool searches_anew = false;
};

/// Decides whether the robot knows where it is: found, lost, found again. Without threads and
/// clocks.
class LocalisationMonitor {
public:
  explicit LocalisationMonitor(const LocalisationMonitorOptions& options = {})
    : options_(options) {}

  LocalisationVerdict add(const LocalisationEvidence& x);

  LocalisationState state() const { return state_; }

private:
  bool is_found(const LocalisationEvidence& x) const;
  LocalisationVerdict follow(const LocalisationEvidence& x);
  LocalisationVerdict search(const LocalisationEvidence& x);
  void begin_search(std::int64_t time);

  LocalisationMonitorOptions options_;
  LocalisationState state_ = LocalisationState::starting;
  bool has_begun_ = false;
  /// Time of the last scan that fitted.
  std::int64_t fitted_ = 0;
  /// When the search began, and the first since the robot was found.
  std::int64_t search_began_ = 0;
  std::int64_t missing_since_ = 0;
  double way_ = 0;
  std::size_t updates_ = 0;
  std::string lost_reason_;
};

} // namespace castor::mapping
