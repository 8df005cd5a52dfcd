#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/mapping/logs/robot_log.hpp"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping {

/// Points that a rotating laser or a depth camera saw at once.
struct LoggedCloud {
  /// Microseconds by the log's own clock.
  std::int64_t time = 0;
  /// The sensor on the robot.
  geometry::Point3 sensor;
  /// On the robot: x forward, y to the left, z up; metres.
  std::vector<geometry::Point3> points;
  /// Where the wheels said that the robot was.
  Pose2 odometry;
};

struct RawlogOptions {
  /// The scans of this sensor; if empty, those of the sensor with the most scans.
  std::string laser;
};

struct Rawlog {
  /// Scans of one laser, with the odometry by then.
  RobotLog log;
  std::vector<LoggedCloud> clouds;
  /// What there is in the file, as "CObservation2DRangeScan LASER" or "CActionRobotMovement2D",
  /// with how often.
  std::map<std::string, std::size_t> contents;
};

struct RawlogResult {
  /// Nothing if there are errors.
  std::optional<Rawlog> rawlog;
  std::vector<Diagnostic> diagnostics;
};

/// Reads a dataset of the Mobile Robot Programming Toolkit (MRPT), compressed by gzip or not, with
/// MRPT. Increments of odometry are added up; a laser that hangs upside down is turned over.
///
/// Errors: no such file; an object that cannot be read, with its byte (of the uncompressed file);
/// no object at all; neither a planar laser scan nor a cloud, with what is there instead. Warnings:
/// time stamps that run backward or are missing (the scans are 0.1 s apart then), scans of a laser
/// that is tilted by more than 5 degrees, which are left out. Notes: other lasers.
RawlogResult read_rawlog(const std::filesystem::path& file, const RawlogOptions& options = {});

} // namespace castor::mapping
