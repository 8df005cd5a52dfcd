#include "castor/mapping/slam/scan_matcher.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace castor::mapping {

namespace {

// Linear system of one Gauss-Newton step: x, y, heading.
struct NormalEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double points = 0;
  double weight = 0;
  double squares = 0;
};

PoseCovariance covariance_of(const Eigen::Matrix3d& information) {
  // A direction that nothing is known of has a deviation of 10 m, and not infinity.
  Eigen::Matrix3d c =
    (information + Eigen::Vector3d(1e-2, 1e-2, 1e-1).asDiagonal().toDenseMatrix()).inverse();
  return {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
}

// Smallest share of points that notice a translation, if the heading is free.
double observability_of(const NormalEquations& x) {
  if (x.weight <= 0 || x.information(2, 2) <= 0)
    return 0;
  Eigen::Matrix2d translation = x.information.topLeftCorner<2, 2>() -
                                x.information.topRightCorner<2, 1>() *
                                  x.information.bottomLeftCorner<1, 2>() / x.information(2, 2);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(translation, Eigen::EigenvaluesOnly);
  return std::max(0., solver.eigenvalues()(0) / x.weight);
}

} // namespace

ScanMatch ScanMatcher::match(const PointMap& map, const SurfacePoints& scan, const Pose2& guess,
                             const std::optional<PosePrior>& prior) const {
  ScanMatch result;
  result.pose = guess;
  auto oriented = std::count_if(scan.begin(), scan.end(), [](auto& x) { return x.has_normal(); });
  if (map.empty() || oriented == 0)
    return result;
  auto within = options_.first_distance;
  auto pose = guess;
  auto one_over_noise = 1 / (options_.noise * options_.noise);
  for (int i = 0; i < options_.max_iterations; ++i) {
    NormalEquations sums;
    auto c = std::cos(pose.heading);
    auto s = std::sin(pose.heading);
    for (const auto& point : scan) {
      if (!point.has_normal())
        continue;
      Point2 arm{c * point.position.x - s * point.position.y,
                 s * point.position.x + c * point.position.y};
      Point2 normal{c * point.normal.x - s * point.normal.y,
                    s * point.normal.x + c * point.normal.y};
      SurfacePoint here{{pose.x + arm.x, pose.y + arm.y}, normal};
      const auto* there = map.nearest(here, within);
      if (there == nullptr)
        continue;
      // A line between both directions has less noise than one of them.
      auto nx = there->normal.x + normal.x;
      auto ny = there->normal.y + normal.y;
      auto length = std::hypot(nx, ny);
      nx /= length;
      ny /= length;
      auto error =
        nx * (here.position.x - there->position.x) + ny * (here.position.y - there->position.y);
      auto size = std::abs(error);
      auto weight = size <= options_.robust_from ? 1 : options_.robust_from / size;
      Eigen::Vector3d jacobian(nx, ny, ny * arm.x - nx * arm.y);
      sums.information += weight * jacobian * jacobian.transpose();
      sums.gradient += weight * error * jacobian;
      sums.points += 1;
      sums.weight += weight;
      sums.squares += weight * error * error;
    }
    if (sums.points < 5)
      return result;
    Eigen::Matrix3d information = sums.information * one_over_noise;
    Eigen::Vector3d gradient = sums.gradient * one_over_noise;
    if (prior) {
      Eigen::Vector3d known(1 / (prior->translation * prior->translation),
                            1 / (prior->translation * prior->translation),
                            1 / (prior->heading * prior->heading));
      Eigen::Vector3d off(pose.x - guess.x, pose.y - guess.y,
                          normalised(pose.heading - guess.heading));
      information.diagonal() += known;
      gradient += known.cwiseProduct(off);
    } else {
      information.diagonal() += Eigen::Vector3d(1, 1, 1);
    }
    Eigen::Vector3d step = information.ldlt().solve(-gradient);
    if (!step.allFinite())
      return result;
    pose.x += step.x();
    pose.y += step.y();
    pose.heading = normalised(pose.heading + step.z());
    auto is_last = within <= options_.last_distance && std::hypot(step.x(), step.y()) < 1e-4 &&
                   std::abs(step.z()) < 1e-4;
    if (is_last || i + 1 == options_.max_iterations) {
      result.pose = pose;
      result.covariance = covariance_of(sums.information * one_over_noise);
      result.matched = sums.points / static_cast<double>(oriented);
      result.deviation = std::sqrt(sums.squares / sums.weight);
      result.observability = observability_of(sums);
      break;
    }
    within = std::max(options_.last_distance, within * options_.shrinking);
  }
  return result;
}

} // namespace castor::mapping
