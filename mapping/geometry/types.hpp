#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>

/// Geometry that the subarchitectures share: points, poses, boxes and cameras, and the frames that
/// they are given in. Lengths are metres.
namespace castor::geometry {

// Usual names of frames; any other name will do.

/// Fixed in the world.
inline constexpr const char* map_frame = "map";
/// Where the robot was switched on; drifts against the map.
inline constexpr const char* odometry_frame = "odometry";
/// The robot: x forward, y to the left, z up.
inline constexpr const char* base_frame = "base";
/// The middle of the table: z up, z = 0 its surface.
inline constexpr const char* table_frame = "table";

/// A point in an image; pixels, x to the right, y down, (0, 0) the centre of the upper left pixel.
struct Point2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point2&, const Point2&) = default;
};

/// A point in a frame that the context names.
struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Point3&, const Point3&) = default;
};

/// A unit quaternion.
struct Rotation {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Rotation&, const Rotation&) = default;
};

/// Where a body is and how it is turned in a frame: p_frame = rotation * p_body + position.
struct Pose {
  Point3 position;
  Rotation rotation;
  /// Name of the frame; empty if it is not known, so that nothing can be related to the pose.
  std::string frame = {};

  friend bool operator==(const Pose&, const Pose&) = default;
};

/// A box along the axes of a frame.
struct AlignedBox {
  Point3 centroid;
  Point3 size;
  /// Name of the frame, as in Pose.
  std::string frame = {};

  friend bool operator==(const AlignedBox&, const AlignedBox&) = default;
};

/// A pinhole camera with the usual lens distortion (radial k1..k3, tangential t1, t2). Its body
/// coordinates are x to the right, y down, z forward; fx, fy, cx, cy are pixels.
struct Camera {
  std::int32_t number = 0;
  Pose pose;
  std::int32_t width = 0;
  std::int32_t height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  double k1 = 0;
  double k2 = 0;
  double k3 = 0;
  double t1 = 0;
  double t2 = 0;
  /// Not calibrated: all but the size is assumed, so that where things are is not really known.
  bool is_assumed = false;

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// Entry: pose of a frame in its parent, which is `pose.frame`. One entry for each frame, which is
/// overwritten whenever the frame has moved. Frames are a tree: each has one parent at most.
struct Transform {
  /// The frame that has this pose.
  std::string frame;
  Pose pose;
  /// When that was so, microseconds since the system began.
  std::int64_t time = 0;
  /// Holds at all times, as of a camera that is screwed to the robot.
  bool is_fixed = false;

  friend bool operator==(const Transform&, const Transform&) = default;
};

CASTOR_REFLECT(Point2, x, y)
CASTOR_REFLECT(Point3, x, y, z)
CASTOR_REFLECT(Rotation, w, x, y, z)
CASTOR_REFLECT(Pose, position, rotation, frame)
CASTOR_REFLECT(AlignedBox, centroid, size, frame)
CASTOR_REFLECT(Camera, number, pose, width, height, fx, fy, cx, cy, k1, k2, k3, t1, t2, is_assumed)
CASTOR_REFLECT(Transform, frame, pose, time, is_fixed)

} // namespace castor::geometry
