#include "castor/mapping/body/footprint.hpp"

#include "castor/mapping/body/path_follower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace castor::mapping {

namespace {

Segment side_of(const Polygon& x, std::size_t i) {
  return {x[i], x[(i + 1) % x.size()]};
}

double distance_from_outline(const Polygon& x, const Point2& p) {
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i)
    result = std::min(result, distance(side_of(x, i), p));
  return result;
}

} // namespace

Footprint::Footprint(Polygon outline) : outline_(std::move(outline)) {
  if (outline_.size() < 3 || !contains(outline_, {}))
    throw std::invalid_argument(
      "a footprint is a polygon around the robot's middle, 0 0: write its "
      "corners in order, at least three");
  for (const auto& x : outline_)
    outer_radius_ = std::max(outer_radius_, distance(x, Point2{}));
  inner_radius_ = distance_from_outline(outline_, {});
}

double Footprint::distance_from(const Point2& on_robot) const {
  return contains(outline_, on_robot) ? 0 : distance_from_outline(outline_, on_robot);
}

double Footprint::clearance(const Pose2& robot,
                            const std::function<double(const Point2&)>& clearance_at) const {
  // Nothing nearer than the best so far is skipped, but for corners between two samples.
  constexpr double near = 0.05; // metres
  constexpr double fine = 0.002;
  constexpr double coarse = 0.02;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const auto side = side_of(outline_, i);
    const double whole = length(side);
    for (double at = 0; at < whole;) {
      const double here = clearance_at(transform(robot, point_at(side, at / whole)));
      best = std::min(best, here);
      at += std::max(here - best, here < near ? fine : coarse);
    }
  }
  return best;
}

Footprint parse_footprint(std::string_view text, const std::string& option) {
  auto read = parse_path(text, option);
  if (has_errors(read.problems))
    throw std::invalid_argument(render(read.problems.front()));
  try {
    return Footprint(std::move(read.path));
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(fmt::format("{}: {}", option, e.what()));
  }
}

} // namespace castor::mapping
