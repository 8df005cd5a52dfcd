#include "castor/perception/vision/recognition/outline_models.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"

namespace castor::vision {

using namespace geometry;

using Eigen::Vector3d;

namespace {

struct Direction {
  double x = 0;
  double y = 0;
};

using Directions = std::array<Direction, std::tuple_size_v<Support>>;

const Directions& support_directions() {
  static const Directions directions = [] {
    Directions result;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(result.size());
      result[i] = {std::cos(angle), -std::sin(angle)};
    }
    return result;
  }();
  return directions;
}

/// Projects points, and remembers if one was out of view.
class Projector {
public:
  explicit Projector(const Camera& camera) : camera_(camera) {
    // nop
  }

  Point2 operator()(const Vector3d& point) {
    const auto pixel = project(camera_, to_point(point));
    all_seen_ = all_seen_ && pixel.has_value();
    return pixel.value_or(Point2{});
  }

  bool all_seen() const { return all_seen_; }

private:
  const Camera& camera_;
  bool all_seen_ = true;
};

/// Points around an upright axis at `height`.
std::vector<Vector3d> ring(const Stand& stand, double height) {
  constexpr int turns = 32;
  std::vector<Vector3d> points;
  for (int i = 0; i < turns; ++i) {
    const double angle = 2 * std::numbers::pi * i / turns;
    points.emplace_back(stand.x + stand.width / 2 * std::cos(angle),
                        stand.y + stand.width / 2 * std::sin(angle), height);
  }
  return points;
}

/// What is hidden falls short of its outline; what sticks out was taken for a part of it. That is
/// rarer.
constexpr double hidden_loss = 0.6;

/// Iteratively reweighted least squares.
class Aligner {
public:
  /// \param start the middle of the half of the directions that the first estimate is from,
  ///        degrees; all of them if negative.
  Aligner(const Support& model, const Support& outline, double tolerance, double start)
    : model_(model), outline_(outline), tolerance_(tolerance) {
    const double angle = start * std::numbers::pi / 180;
    const Direction middle{std::cos(angle), -std::sin(angle)};
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const auto& direction = support_directions()[i];
      const bool counts = start < 0 || direction.x * middle.x + direction.y * middle.y > -0.05;
      weights_[i] = counts ? 1 : 0;
    }
  }

  void improve(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      solve();
      weigh();
    }
  }

  const Alignment& alignment() const { return alignment_; }

private:
  void solve() {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const auto& direction = support_directions()[i];
      const Vector3d row(model_[i], direction.x, direction.y);
      const Vector3d weighted = weights_[i] * row;
      normal += weighted * row.transpose();
      right += outline_[i] * weighted;
    }
    const Vector3d solution = normal.inverse() * right;
    alignment_ = {solution.x(), {solution.y(), solution.z()}, 0};
  }

  void weigh() {
    double sum = 0;
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const auto& direction = support_directions()[i];
      const double excess = alignment_.scale * model_[i] + direction.x * alignment_.shift.x +
                            direction.y * alignment_.shift.y - outline_[i];
      const double share = excess > 0 ? hidden_loss : 1;
      const double squared = excess * excess / (tolerance_ * tolerance_);
      // The loss of S. Geman and D. McClure (1987).
      const double kept = 1 / (1 + squared);
      weights_[i] = share * kept * kept;
      sum += share * squared * kept;
    }
    alignment_.deviation = tolerance_ * std::sqrt(sum / static_cast<double>(outline_.size()));
  }

  const Support& model_;
  const Support& outline_;
  double tolerance_;
  Support weights_;
  Alignment alignment_;
};

} // namespace

Support support_of(const std::vector<Point2>& points) {
  Support support;
  const auto& directions = support_directions();
  for (std::size_t i = 0; i < support.size(); ++i) {
    double reach = std::numeric_limits<double>::lowest();
    for (const auto& point : points)
      reach = std::max(reach, directions[i].x * point.x + directions[i].y * point.y);
    support[i] = reach;
  }
  return support;
}

std::optional<OutlineModel> model_box(const Camera& camera, const Stand& stand, double yaw,
                                      double height) {
  Projector projector(camera);
  const double half_diagonal = stand.width / std::numbers::sqrt2;
  std::array<Vector3d, 4> foot;
  std::array<Point2, 4> below;
  std::array<Point2, 4> above;
  for (std::size_t i = 0; i < 4; ++i) {
    const double angle = yaw + std::numbers::pi * (static_cast<double>(i) / 2 + 0.25);
    foot[i] = {stand.x + half_diagonal * std::cos(angle), stand.y + half_diagonal * std::sin(angle),
               0};
    below[i] = projector(foot[i]);
    above[i] = projector(foot[i] + height * stand.width * Vector3d::UnitZ());
  }
  if (!projector.all_seen())
    return std::nullopt;
  OutlineModel model;
  model.points.assign(below.begin(), below.end());
  model.points.insert(model.points.end(), above.begin(), above.end());
  model.support = support_of(model.points);
  model.faces.push_back({above.begin(), above.end()});
  const Vector3d eye = to_eigen(camera.pose.position);
  std::array<bool, 4> in_view{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const Vector3d along = foot[next] - foot[i];
    const Vector3d outwards(along.y(), -along.x(), 0);
    in_view[i] = outwards.dot(eye - foot[i]) > 0;
    if (in_view[i])
      model.faces.push_back({below[i], below[next], above[next], above[i]});
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t before = (i + 3) % 4;
    if (in_view[before] && in_view[i])
      model.upright = {below[i], above[i]};
    if (in_view[i] && !in_view[before]) {
      // Anticlockwise from above is from left to right on the near side.
      model.rim.push_back(above[i]);
      for (std::size_t side = i; in_view[side] && model.rim.size() < 4; side = (side + 1) % 4)
        model.rim.push_back(above[(side + 1) % 4]);
    }
  }
  return model;
}

std::optional<OutlineModel> model_cylinder(const Camera& camera, const Stand& stand,
                                           double height) {
  Projector projector(camera);
  OutlineModel model;
  const auto top = ring(stand, height * stand.width);
  const auto foot = ring(stand, 0);
  std::vector<Point2> above;
  for (const auto& point : top)
    above.push_back(projector(point));
  model.points = above;
  std::vector<Point2> front;
  const Vector3d eye = to_eigen(camera.pose.position);
  const Vector3d towards(eye.x() - stand.x, eye.y() - stand.y, 0);
  for (std::size_t i = 0; i < foot.size(); ++i) {
    model.points.push_back(projector(foot[i]));
    const Vector3d outwards(foot[i].x() - stand.x, foot[i].y() - stand.y, 0);
    // The middle of the side in view.
    if (outwards.dot(towards) > 0.5 * outwards.norm() * towards.norm())
      model.rim.push_back(above[i]);
  }
  if (!projector.all_seen())
    return std::nullopt;
  std::sort(model.rim.begin(), model.rim.end(),
            [](const Point2& a, const Point2& b) { return a.x < b.x; });
  model.support = support_of(model.points);
  model.faces.push_back(std::move(above));
  return model;
}

std::optional<OutlineModel> model_sphere(const Camera& camera, const Stand& stand) {
  const double radius = stand.width / 2;
  const Vector3d centre(stand.x, stand.y, radius);
  const Vector3d away = centre - to_eigen(camera.pose.position);
  const double distance = away.norm();
  if (distance <= radius)
    return std::nullopt;
  // The circle in which the cone of rays from the eye touches the sphere.
  const Vector3d axis = away / distance;
  const Vector3d middle = centre - radius * radius / distance * axis;
  const double reach = radius * std::sqrt(1 - radius * radius / (distance * distance));
  const Vector3d u = axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  Projector projector(camera);
  OutlineModel model;
  constexpr int turns = 32;
  for (int i = 0; i < turns; ++i) {
    const double angle = 2 * std::numbers::pi * i / turns;
    model.points.push_back(projector(middle + reach * (std::cos(angle) * u + std::sin(angle) * v)));
  }
  if (!projector.all_seen())
    return std::nullopt;
  model.support = support_of(model.points);
  return model;
}

Alignment align(const Support& model, const Support& outline, double tolerance) {
  // From above, what is nearer hides the lower parts of things; or one side.
  constexpr std::array<double, 4> starts{-1, 90, 30, 150};
  constexpr int first_rounds = 2;
  constexpr int last_rounds = 3;
  std::optional<Aligner> best;
  for (const double start : starts) {
    Aligner aligner(model, outline, tolerance, start);
    aligner.improve(first_rounds);
    if (!best || aligner.alignment().deviation < best->alignment().deviation)
      best.emplace(aligner);
  }
  best->improve(last_rounds);
  return best->alignment();
}

} // namespace castor::vision
