#include "castor/mapping/geometry/seen_solid.hpp"

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"
#include "castor/mapping/geometry/poses.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace castor::geometry {

namespace {

using Eigen::VectorXd;
using std::numbers::pi;

constexpr int outline_directions = 48;
constexpr double flat_height = 0.005; // metres
/// Things are no smaller or larger, metres.
constexpr double least_length = 0.004;
constexpr double most_length = 0.6;
constexpr int most_rounds = 40;
/// Regions that are so near to each other may be of things before each other, pixels.
constexpr double touching = 3;
/// Standard deviation of how far an outline reaches in a direction, pixels. Those of neighbouring
/// directions are not independent.
constexpr double outline_deviation = 1;
/// How much it counts if a solid goes on where it may be hidden.
constexpr double hidden_share = 0.1;

/// What is fitted: x, y, then what the kind of outline has.
enum class Model { ball, cylinder, cube, block, disc, plate };

Model model_of(const std::string& shape) {
  if (shape == "sphere")
    return Model::ball;
  if (shape == "cylinder")
    return Model::cylinder;
  if (shape == "cube")
    return Model::cube;
  if (shape == "circle" || shape == "disc" || shape == "triangle")
    return Model::disc;
  if (shape == "square" || shape == "rectangle")
    return Model::plate;
  return Model::block;
}

double kept(double length) {
  return std::clamp(length, least_length, most_length);
}

SeenSolid solid_of(Model model, const VectorXd& p) {
  SeenSolid result;
  double turn = 0;
  switch (model) {
    case Model::ball:
      result.solid = sphere(kept(p[2]));
      break;
    case Model::cylinder:
      result.solid = cylinder(kept(p[2]), kept(p[3]));
      break;
    case Model::disc:
      result.solid = cylinder(kept(p[2]), flat_height);
      break;
    case Model::cube:
      result.solid = box(kept(p[3]), kept(p[3]), kept(p[3]));
      turn = p[2];
      break;
    case Model::block:
      result.solid = box(kept(p[3]), kept(p[4]), kept(p[5]));
      turn = p[2];
      break;
    case Model::plate:
      result.solid = box(kept(p[3]), kept(p[4]), flat_height);
      turn = p[2];
      break;
  }
  result.pose.position = {p[0], p[1], result.solid.size.z / 2};
  result.pose.rotation = rotation_about_z(turn);
  return result;
}

/// Points whose images have the solid's outline as their hull; for what is round, nearly.
std::vector<Point3> outline_points(const SeenSolid& x, const Point3& eye) {
  std::vector<Point3> result;
  const auto& size = x.solid.size;
  const auto add = [&](double a, double b, double c) {
    result.push_back(transform(x.pose, Point3{a, b, c}));
  };
  constexpr int around = 40;
  if (x.solid.kind == SolidKind::box) {
    for (const double a : {-0.5, 0.5})
      for (const double b : {-0.5, 0.5})
        for (const double c : {-0.5, 0.5})
          add(a * size.x, b * size.y, c * size.z);
  } else if (x.solid.kind == SolidKind::cylinder) {
    for (int i = 0; i < around; ++i)
      for (const double c : {-0.5, 0.5})
        add(size.x / 2 * std::cos(2 * pi * i / around), size.x / 2 * std::sin(2 * pi * i / around),
            c * size.z);
  } else {
    // The circle along which rays touch the ball.
    const Eigen::Vector3d middle = to_eigen(x.pose.position);
    const Eigen::Vector3d to_eye = to_eigen(eye) - middle;
    const double radius = size.x / 2;
    const double away = std::max(to_eye.norm(), radius * 1.01);
    const Eigen::Vector3d axis = to_eye.normalized();
    const Eigen::Vector3d u = axis.unitOrthogonal();
    const Eigen::Vector3d v = axis.cross(u);
    const double touch = radius * std::sqrt(1 - radius * radius / (away * away));
    for (int i = 0; i < around; ++i)
      result.push_back(
        to_point(middle + radius * radius / away * axis +
                 touch * (std::cos(2 * pi * i / around) * u + std::sin(2 * pi * i / around) * v)));
  }
  return result;
}

/// How far a point reaches in one of the directions.
double reach_of(const Point2& point, int direction) {
  const double angle = 2 * pi * direction / outline_directions;
  return point.x * std::cos(angle) + point.y * std::sin(angle);
}

/// How far the points reach in each direction.
VectorXd supports(const std::vector<Point2>& points) {
  VectorXd result(outline_directions);
  for (int i = 0; i < outline_directions; ++i) {
    double most = -1e12;
    for (const auto& point : points)
      most = std::max(most, reach_of(point, i));
    result[i] = most;
  }
  return result;
}

/// Whether the outline ends at another region in each direction.
std::vector<bool> ends_at_others(const std::vector<Point2>& contour,
                                 const std::vector<std::vector<Point2>>& others) {
  std::vector<bool> result;
  for (int i = 0; i < outline_directions; ++i) {
    const auto end = std::ranges::max(contour, {}, [i](const Point2& x) { return reach_of(x, i); });
    result.push_back(std::ranges::any_of(others, [&](const auto& other) {
      return std::ranges::any_of(
        other, [&](const Point2& x) { return std::hypot(x.x - end.x, x.y - end.y) <= touching; });
    }));
  }
  return result;
}

class Fit {
public:
  Fit(Model model, const std::vector<Point2>& contour, const Camera& camera,
      const std::vector<std::vector<Point2>>& others)
    : model_(model), camera_(camera), may_go_on_(ends_at_others(contour, others)),
      // The region reaches half a pixel further than the centres of its pixels.
      wanted_(supports(contour).array() + 0.5) {
    // nop
  }

  /// Nothing if it leaves the picture's part of the table.
  std::optional<SeenSolid> run(VectorXd p) const {
    auto residual = residual_of(p);
    if (!residual)
      return {};
    double damping = 1e-3;
    Eigen::MatrixXd normal;
    for (int i = 0; i < most_rounds; ++i) {
      const auto jacobian = jacobian_at(p, *residual);
      if (!jacobian)
        return {};
      normal = jacobian->transpose() * *jacobian;
      const VectorXd slope = jacobian->transpose() * *residual;
      bool is_better = false;
      double gained = 0;
      for (int tries = 0; tries < 8 && !is_better; ++tries) {
        Eigen::MatrixXd damped = normal;
        damped.diagonal() +=
          damping * normal.diagonal() + VectorXd::Constant(p.size(), 1e-9 * (1 + normal.trace()));
        const VectorXd next = p - damped.ldlt().solve(slope);
        const auto other = residual_of(next);
        is_better = other && other->squaredNorm() < residual->squaredNorm();
        if (!is_better) {
          damping *= 10;
          continue;
        }
        gained = residual->squaredNorm() - other->squaredNorm();
        p = next;
        residual = other;
        damping = std::max(1e-9, damping / 10);
      }
      if (!is_better || gained < 1e-6)
        break;
    }
    auto result = solid_of(model_, p);
    result.pose.frame = camera_.pose.frame;
    result.error = std::sqrt(residual->squaredNorm() / outline_directions);
    result.height_deviation = height_deviation(normal);
    return result;
  }

private:
  /// Nothing if a solid that is a little different leaves the picture's part of the table.
  std::optional<Eigen::MatrixXd> jacobian_at(const VectorXd& p, const VectorXd& residual) const {
    constexpr double step = 1e-5;
    Eigen::MatrixXd result(outline_directions, p.size());
    for (Eigen::Index j = 0; j < p.size(); ++j) {
      VectorXd moved = p;
      moved[j] += step;
      const auto other = residual_of(moved);
      if (!other)
        return {};
      result.col(j) = (*other - residual) / step;
    }
    return result;
  }

  /// From above, a higher solid looks like a wider one: by the covariance of what was fitted.
  double height_deviation(const Eigen::MatrixXd& normal) const {
    if (model_ != Model::cylinder && model_ != Model::block)
      return 0;
    // Within the range of lengths, however little the outline says.
    const auto last = normal.cols() - 1;
    const double least = 1 / (most_length * most_length);
    Eigen::MatrixXd known = normal / (outline_deviation * outline_deviation);
    known.diagonal().array() += least;
    return std::sqrt(known.inverse()(last, last));
  }

  std::optional<VectorXd> residual_of(const VectorXd& p) const {
    std::vector<Point2> pixels;
    for (const auto& point : outline_points(solid_of(model_, p), camera_.pose.position)) {
      const auto pixel = project(camera_, point);
      if (!pixel)
        return {};
      pixels.push_back(*pixel);
    }
    VectorXd result = supports(pixels) - wanted_;
    for (int i = 0; i < outline_directions; ++i)
      if (may_go_on_[static_cast<std::size_t>(i)] && result[i] > 0)
        result[i] *= hidden_share;
    return result;
  }

  Model model_;
  const Camera& camera_;
  std::vector<bool> may_go_on_;
  VectorXd wanted_;
};

/// First guesses: where the outline's middle is on the table, as wide as the outline is.
std::vector<VectorXd> guesses(Model model, const Point2& middle, double width) {
  const auto guess = [&](std::initializer_list<double> rest) {
    VectorXd result(static_cast<Eigen::Index>(rest.size()) + 2);
    result[0] = middle.x;
    result[1] = middle.y;
    Eigen::Index i = 2;
    for (const double x : rest)
      result[i++] = x;
    return result;
  };
  switch (model) {
    case Model::ball:
    case Model::disc:
      return {guess({width})};
    case Model::cylinder:
      return {guess({width, width / 2}), guess({width, 1.5 * width})};
    default:
      break;
  }
  std::vector<VectorXd> result;
  for (const double turn : {0.0, pi / 8, pi / 4, 3 * pi / 8}) {
    const double side = 0.75 * width;
    if (model == Model::cube)
      result.push_back(guess({turn, side}));
    else if (model == Model::plate)
      result.push_back(guess({turn, side, side}));
    else
      for (const double ratio : {0.6, 1.6})
        result.push_back(guess({turn, side, ratio * side, side}));
  }
  return result;
}

} // namespace

std::optional<SeenSolid> seen_solid(const std::string& shape, const std::vector<Point2>& contour,
                                    const Camera& camera,
                                    const std::vector<std::vector<Point2>>& others) {
  if (contour.size() < 3)
    return {};
  const auto [left, right] = std::ranges::minmax(contour, {}, &Point2::x);
  const auto [top, bottom] = std::ranges::minmax(contour, {}, &Point2::y);
  const double row = (top.y + bottom.y) / 2;
  const auto from = back_project(camera, {left.x, row});
  const auto to = back_project(camera, {right.x, row});
  if (!from || !to)
    return {};
  const Point2 middle{(from->x + to->x) / 2, (from->y + to->y) / 2};
  const auto model = model_of(shape);
  const Fit fit(model, contour, camera, others);
  std::optional<SeenSolid> best;
  for (const auto& guess : guesses(model, middle, distance(*from, *to)))
    if (auto found = fit.run(guess); found && (!best || found->error < best->error))
      best = std::move(found);
  return best;
}

} // namespace castor::geometry
