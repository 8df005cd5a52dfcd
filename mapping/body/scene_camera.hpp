#pragma once

#include "castor/mapping/body/noise.hpp"
#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"
#include "castor/mapping/geometry/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor::mapping {

struct CameraOptions {
  int width = 160;
  int height = 120;
  /// Of the whole image, degrees.
  double horizontal_fov = 60;
  /// Above the floor and before the robot's middle, metres. It looks forward, level.
  double above = 0.6;
  double ahead = 0.1;
  /// Metres; the depth of what is further away is not measured.
  double max_range = 8;
  /// Standard deviation of the depth of something 1 m away, metres; it grows with the square of the
  /// depth, as that of triangulating sensors (K. Khoshelham, "Accuracy analysis of Kinect depth
  /// data", 2011).
  double depth_noise = 0.002;
  /// Standard deviation of a channel's value.
  double colour_noise = 2;
};

/// A picture and the depth of each of its pixels, row by row from above.
struct SceneView {
  /// B, G, R.
  std::vector<std::uint8_t> colours;
  /// Along the camera's axis, metres; 0 where it was not measured.
  std::vector<float> depths;
};

/// A camera that sees colours and depths of a building and of the people in it.
class SceneCamera {
public:
  /// \throws std::invalid_argument unless the sizes, the angle and the range are positive.
  SceneCamera(const CameraOptions& options, std::uint64_t seed);

  /// @param robot its true pose
  /// @param ceiling height of the building, metres
  SceneView look(std::span<const Solid> solids, std::span<const Disc> people, double ceiling,
                 const Pose2& robot);

  /// The camera in the robot's frame, x forward and z up.
  geometry::Camera model() const;

  /// The measured points of a view in the robot's frame: x, y, z of one after the other.
  std::vector<float> points_of(const SceneView& view) const;

private:
  /// Pixels.
  double focal_length() const;
  /// Tangents of the angles to the left and upwards that a pixel is seen at.
  double left_of(int column) const;
  double up_of(int row) const;

  CameraOptions options_;
  Noise noise_;
};

} // namespace castor::mapping
