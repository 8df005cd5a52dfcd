#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The metric of the SLAM benchmark (Kuemmerle et al., "On measuring the accuracy of SLAM
/// algorithms", Autonomous Robots 27, 2009): relations between poses that people have confirmed are
/// compared with those of an estimate. It does not ask for a global frame.
namespace castor::slam_benchmark {

/// Pose of the robot at one time as seen from where it was at another.
struct Relation {
  /// Microseconds by the log's clock.
  std::int64_t from = 0;
  std::int64_t to = 0;
  mapping::Pose2 pose;

  friend bool operator==(const Relation&, const Relation&) = default;
};

/// A pose of a path.
struct TimedPose {
  std::int64_t time = 0;
  mapping::Pose2 pose;
};

struct RelationsResult {
  /// Nothing if there are errors.
  std::optional<std::vector<Relation>> relations;
  std::vector<Diagnostic> diagnostics;
};

/// Reads lines "time1 time2 x y z roll pitch yaw" (s, m, rad); empty lines and those that begin
/// with # are left out.
RelationsResult parse_relations(std::string_view text, const std::string& file);

/// The same for a file, which may be compressed by gzip.
RelationsResult read_relations(const std::filesystem::path& file);

struct PathResult {
  /// In order of time; nothing if there are errors.
  std::optional<std::vector<TimedPose>> path;
  std::vector<Diagnostic> diagnostics;
};

/// Reads lines "time x y heading" (s, m, rad), as the driver writes them; empty lines and those
/// that begin with # are left out.
PathResult parse_path(std::string_view text, const std::string& file);

/// The same for a file.
PathResult read_path(const std::filesystem::path& file);

struct Statistics {
  double mean = 0;
  double deviation = 0;
  double most = 0;
};

/// Statistics of numbers; the deviation is that of a sample of all (divided by n - 1).
Statistics statistics_of(const std::vector<double>& numbers);

struct RelationErrors {
  /// Absolute errors: m and radians.
  Statistics translation;
  Statistics rotation;
  /// Squared errors: m2 and rad2.
  Statistics squared_translation;
  Statistics squared_rotation;
  /// Relations that were compared, and those with a time that the path has no pose at.
  std::size_t relations = 0;
  std::size_t without_pose = 0;
};

/// How much later the path's times are than those that relations have for the same, us: the median
/// difference to the nearest pose. Relations were made from logs whose times were rounded, or that
/// were written by other versions of the logger.
std::int64_t clock_offset(const std::vector<TimedPose>& path,
                          const std::vector<Relation>& relations);

/// The relations' times may be off by clock_offset().
/// @param path in order of time; between its poses it is interpolated
/// @param most_gap relations at a time that is further from poses than this are left out, us
RelationErrors relation_errors(const std::vector<TimedPose>& path,
                               const std::vector<Relation>& relations,
                               std::int64_t most_gap = 500000);

/// Pose of the path at that time; nothing outside of it and in gaps.
std::optional<mapping::Pose2> pose_at(const std::vector<TimedPose>& path, std::int64_t time,
                                      std::int64_t most_gap);

struct TrajectoryErrors {
  /// After alignment: m and radians.
  double root_mean_square = 0;
  double median = 0;
  double most = 0;
  double heading_mean = 0;
  std::size_t poses = 0;
};

/// Absolute trajectory error: distances of a path from the truth at the same times, after the rigid
/// motion of the plane that makes their squares least (Horn 1987; Sturm et al., "A benchmark for
/// the evaluation of RGB-D SLAM systems", 2012).
TrajectoryErrors trajectory_errors(const std::vector<TimedPose>& path,
                                   const std::vector<TimedPose>& truth,
                                   std::int64_t most_gap = 500000);

} // namespace castor::slam_benchmark
