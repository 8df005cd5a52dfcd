#include "castor/mapping/building/scene_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::mapping {

namespace {

constexpr double everywhere = std::numeric_limits<double>::infinity();

/// Where a ray over the floor enters and leaves the outline of a solid.
std::optional<std::pair<double, double>> crossing(const Solid& x, const Point2& eye,
                                                  double direction) {
  const auto ray = between(x.pose, Pose2{eye.x, eye.y, direction});
  const double ux = std::cos(ray.heading);
  const double uy = std::sin(ray.heading);
  double enter = -everywhere;
  double leave = everywhere;
  if (x.shape == SolidShape::disc) {
    const double along = -(ray.x * ux + ray.y * uy);
    const double aside = ray.x * uy - ray.y * ux;
    const double square = x.length * x.length / 4 - aside * aside;
    if (square < 0)
      return std::nullopt;
    enter = along - std::sqrt(square);
    leave = along + std::sqrt(square);
  } else {
    auto clip = [&](double o, double u, double half) {
      if (u == 0) {
        if (std::abs(o) > half)
          leave = -everywhere;
        return;
      }
      enter = std::max(enter, std::min((-half - o) / u, (half - o) / u));
      leave = std::min(leave, std::max((-half - o) / u, (half - o) / u));
    };
    clip(ray.x, ux, x.length / 2);
    clip(ray.y, uy, x.width / 2);
  }
  if (leave < 0 || enter > leave)
    return std::nullopt;
  return std::pair{std::max(0.0, enter), leave};
}

} // namespace

SceneSlice::SceneSlice(std::span<const Solid> solids, const Point2& eye, double direction,
                       double max_range, double ceiling)
  : solids_(solids), max_range_(max_range), ceiling_(ceiling) {
  for (std::size_t i = 0; i < solids.size(); ++i)
    if (auto found = crossing(solids[i], eye, direction); found && found->first <= max_range)
      stretches_.push_back({found->first, found->second, i});
  std::ranges::sort(stretches_, {}, &Stretch::enter);
}

std::optional<SceneHit> SceneSlice::first(double height, double slope) const {
  std::optional<SceneHit> result;
  double nearest = max_range_;
  // The floor, or the ceiling.
  const double plane = slope < 0 ? 0 : ceiling_;
  if (slope != 0) {
    if (const double along = (plane - height) / slope; along >= 0 && along <= nearest) {
      nearest = along;
      result = SceneHit{along, plane, std::nullopt, slope < 0 ? SolidFace::top : SolidFace::bottom};
    }
  }
  for (const auto& stretch : stretches_) {
    if (stretch.enter > nearest)
      break;
    const auto& solid = solids_[stretch.solid];
    const double at_side = height + slope * stretch.enter;
    if (at_side >= solid.bottom && at_side <= solid.top) {
      nearest = stretch.enter;
      result = SceneHit{nearest, at_side, stretch.solid, SolidFace::side};
      continue;
    }
    // From above or below, within its outline.
    const bool from_above = at_side > solid.top;
    const double level = from_above ? solid.top : solid.bottom;
    if (slope == 0 || from_above != (slope < 0))
      continue;
    const double along = (level - height) / slope;
    if (along > stretch.leave || along >= nearest)
      continue;
    nearest = along;
    result = SceneHit{along, level, stretch.solid, from_above ? SolidFace::top : SolidFace::bottom};
  }
  return result;
}

} // namespace castor::mapping
