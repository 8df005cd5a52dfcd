#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace castor::mapping {

/// Which side of a solid was hit.
enum class SolidFace : std::uint8_t { side, top, bottom };

/// What a ray through the building meets first.
struct SceneHit {
  /// Distance over the floor, metres: that of the ray times this over its share along the floor.
  double along = 0;
  double height = 0;
  /// Index of the solid; nothing if it is the floor or the ceiling.
  std::optional<std::size_t> solid;
  SolidFace face = SolidFace::side;
};

/// The solids of a building in the vertical half plane that a column of an upright camera looks
/// into: what its rays meet is found by going through the few solids in it.
class SceneSlice {
public:
  /// @param solids outlive the slice
  /// @param ceiling height, metres
  SceneSlice(std::span<const Solid> solids, const Point2& eye, double direction, double max_range,
             double ceiling);

  /// The first thing on the ray from the eye's `height` that rises by `slope` metres on each metre
  /// along the floor; nothing within the range.
  std::optional<SceneHit> first(double height, double slope) const;

private:
  /// Where the half plane is within a solid.
  struct Stretch {
    double enter = 0;
    double leave = 0;
    std::size_t solid = 0;
  };

  std::span<const Solid> solids_;
  double max_range_;
  double ceiling_;
  /// By `enter`.
  std::vector<Stretch> stretches_;
};

} // namespace castor::mapping
