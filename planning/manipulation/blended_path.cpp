#include "castor/planning/manipulation/blended_path.hpp"

#include "castor/planning/manipulation/kinematics.hpp"

#include <algorithm>
#include <stdexcept>

namespace castor::manipulation {

namespace {

// Shorter lines are left out: they have no direction.
constexpr double least_length = 1e-9;
// Directions that differ by less are one: a corner that is not seen.
constexpr double same_direction = 1e-9;

/// x + share * (y - x) for each joint.
Configuration between(const Configuration& x, const Configuration& y, double share) {
  auto result = x;
  for (std::size_t i = 0; i < x.size(); ++i)
    result[i] += share * (y[i] - x[i]);
  return result;
}

} // namespace

BlendedPath::BlendedPath(const std::vector<Configuration>& waypoints,
                         const std::vector<double>& radii) {
  if (waypoints.empty() || waypoints.size() != radii.size())
    throw std::invalid_argument("a path needs waypoints, and a radius for each of them");
  first_ = waypoints.front();
  std::vector<Configuration> corners{first_};
  std::vector<double> corner_radii{0};
  for (std::size_t i = 1; i < waypoints.size(); ++i)
    if (distance(corners.back(), waypoints[i]) > least_length) {
      corners.push_back(waypoints[i]);
      corner_radii.push_back(radii[i]);
    }
  auto from = first_;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const double before = distance(corners[i - 1], corners[i]);
    const double after = distance(corners[i], corners[i + 1]);
    const double radius = std::min({corner_radii[i], before / 2, after / 2});
    if (radius <= least_length) {
      add_line(from, corners[i]);
      from = corners[i];
      continue;
    }
    const auto enter = between(corners[i], corners[i - 1], radius / before);
    const auto leave = between(corners[i], corners[i + 1], radius / after);
    add_line(from, enter);
    add_parabola(enter, corners[i], leave);
    from = leave;
  }
  add_line(from, corners.back());
}

void BlendedPath::add_line(const Configuration& from, const Configuration& to) {
  const double size = distance(from, to);
  if (size <= least_length)
    return;
  Piece piece{length(), length() + size, from, from, Configuration(from.size(), 0)};
  for (std::size_t i = 0; i < from.size(); ++i)
    piece.b[i] = (to[i] - from[i]) / size;
  pieces_.push_back(std::move(piece));
}

void BlendedPath::add_parabola(const Configuration& from, const Configuration& corner,
                               const Configuration& to) {
  // A quadratic Bezier curve, whose derivative is of length 1 at both ends.
  const double size = 2 * distance(from, corner);
  Piece piece{length(), length() + size, from, from, from};
  for (std::size_t i = 0; i < from.size(); ++i) {
    piece.b[i] = 2 * (corner[i] - from[i]) / size;
    piece.c[i] = (to[i] - 2 * corner[i] + from[i]) / (size * size);
  }
  pieces_.push_back(std::move(piece));
}

Configuration BlendedPath::at(double s) const {
  if (pieces_.empty())
    return first_;
  s = std::clamp(s, 0.0, length());
  auto piece = std::ranges::upper_bound(pieces_, s, {}, &Piece::begin);
  if (piece != pieces_.begin())
    --piece;
  const double d = s - piece->begin;
  auto result = piece->a;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] += d * (piece->b[i] + d * piece->c[i]);
  return result;
}

bool BlendedPath::is_smooth_before(std::size_t piece) const {
  if (piece == 0)
    return false;
  const auto& before = pieces_[piece - 1];
  return distance(slope(before, before.end), pieces_[piece].b) < same_direction;
}

Configuration slope(const BlendedPath::Piece& piece, double s) {
  auto result = piece.b;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] += 2 * piece.c[i] * (s - piece.begin);
  return result;
}

} // namespace castor::manipulation
