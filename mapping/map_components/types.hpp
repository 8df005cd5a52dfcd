#pragma once

#include "castor/mapping/planar/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Requests to the component that writes map files, and what is said of a path by who knows better.
namespace castor::mapping {

/// Call: write the map as it is now. Answer: ExportedMap.
struct ExportMap {
  /// The folder for the files, on the machine of the component; it is made if it does not exist.
  std::string folder;
};

struct ExportedMap {
  /// Paths of the files that were written.
  std::vector<std::string> files;
  /// What was left out, with the reason: "map.ot: there is no octree".
  std::vector<std::string> left_out;

  friend bool operator==(const ExportedMap&, const ExportedMap&) = default;
};

/// Entry: how far the corrected path of a simulated robot is from the true one. There is one, which
/// is overwritten.
struct PathError {
  /// When that was, microseconds since the system began.
  std::int64_t time = 0;
  /// How many keyframes were compared.
  std::int64_t keyframes = 0;
  /// Distances from the true positions, metres, in the frame of the map, which has the heading of
  /// the first scans and so turns the whole map by what they are off.
  double median = 0;
  double most = 0;
  /// The same after the alignment that fits best (the absolute trajectory error of Sturm et al.
  /// 2012): how much the map is bent.
  double aligned_median = 0;
  double aligned_most = 0;
  /// Differences from the true headings, radians.
  double heading_median = 0;
  double heading_most = 0;
  /// How often the robot has run into something.
  std::int64_t collisions = 0;
  /// Smallest distance of the robot from an obstacle, metres.
  double least_clearance = 0;
  /// True length of the way, metres.
  double driven = 0;

  friend bool operator==(const PathError&, const PathError&) = default;
};

/// Entry: true poses of the keyframes, in the order of time. There is one, which is overwritten.
struct TruePath {
  /// Of the scans of the keyframes, microseconds since the system began; as many as `poses`.
  std::vector<std::int64_t> times;
  std::vector<Pose2> poses;

  friend bool operator==(const TruePath&, const TruePath&) = default;
};

/// Entry: how far the pose that localisation tells of a simulated robot is from the true one. There
/// is one, which is overwritten.
struct PoseError {
  /// Of the newest pose that was compared, microseconds since the system began.
  std::int64_t time = 0;
  /// How many poses were told, and in how many of them the state was tracking: those are compared.
  std::int64_t poses = 0;
  std::int64_t tracking = 0;
  /// Distances from the true positions, metres.
  double median = 0;
  double most = 0;
  /// Differences from the true headings, radians.
  double heading_median = 0;
  double heading_most = 0;
  /// How often the robot was lost, and when it was so and was found for the last time,
  /// microseconds; 0: never.
  std::int64_t lost = 0;
  std::int64_t last_lost = 0;
  std::int64_t last_found = 0;

  friend bool operator==(const PoseError&, const PoseError&) = default;
};

CASTOR_REFLECT(ExportMap, folder)
CASTOR_REFLECT(ExportedMap, files, left_out)
CASTOR_REFLECT(PathError, time, keyframes, median, most, aligned_median, aligned_most,
               heading_median, heading_most, collisions, least_clearance, driven)
CASTOR_REFLECT(TruePath, times, poses)
CASTOR_REFLECT(PoseError, time, poses, tracking, median, most, heading_median, heading_most, lost,
               last_lost, last_found)

} // namespace castor::mapping
