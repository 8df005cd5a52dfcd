#pragma once

#include <cstdint>
#include <vector>

#include "castor/perception/vision/tabletop/tabletop_scene.hpp"
#include "castor/perception/vision/types.hpp"

/// Pictures of a table: a ray caster for a few simple bodies under one lamp.
namespace castor::vision {

struct RenderOptions {
  /// Number of the frame; the sensor's noise differs from frame to frame.
  std::uint64_t frame = 0;
  /// Rays towards the lamp per point that may be in a penumbra; at least 1.
  int shadow_samples = 16;
  /// The lamp's radius, metres: how soft the shadows are.
  double lamp_radius = 0.15;
  /// Light from the lamp at the table's middle, and from all around; a white sheet that faces both
  /// is white in the picture if they add up to 1.
  double lamp_intensity = 0.85;
  double ambient_intensity = 0.32;
  /// Gloss of the objects, 0 for matt ones.
  double gloss = 0.25;
  /// Share of the light of each object that its surface mirrors, in the colour of the object, as
  /// metals do; by the object's index, 0 beyond the end. What is mirrored does not mirror.
  std::vector<double> mirroring{};
  /// Further lamps that cast no shadows; metres. Light from each at the table's middle.
  std::vector<Point3> fill_lamps{};
  double fill_intensity = 0.2;
  /// Loss of brightness in the corners of the picture, in [0, 1].
  double vignetting = 0.12;
  /// Rays per pixel at edges; 1 leaves them jagged.
  int edge_samples = 8;
};

/// Renders the scene as seen by `camera`, 3 channels. The same arguments give the same bytes.
/// \throws std::invalid_argument if the camera has no size or focal length, or a count of samples
/// is
///         not positive.
Image render(const TabletopSnapshot& scene, const Camera& camera,
             const RenderOptions& options = {});

/// The same without noise, regardless of TabletopSnapshot::noise.
Image render_without_noise(const TabletopSnapshot& scene, const Camera& camera,
                           const RenderOptions& options = {});

/// Adds pseudo-random noise of the standard deviation `sigma`, in grey levels, determined by `seed`
/// and `frame`.
void add_sensor_noise(Image& image, double sigma, std::uint64_t seed, std::uint64_t frame);

/// The ground truth of render(): 1 channel, the index of the visible object plus 1, and 0 where
/// there is none; placed ones follow the others, and 255 stands for all objects from the 255th on.
/// \throws std::invalid_argument like render().
Image render_labels(const TabletopSnapshot& scene, const Camera& camera);

} // namespace castor::vision
