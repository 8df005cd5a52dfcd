#include "castor/planning/manipulation/damped_least_squares.hpp"

#include "castor/planning/manipulation/kinematic_chain.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <random>

namespace castor::manipulation {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double least_damping = 1e-14;
constexpr double most_damping = 1e6;
// Solutions that are nearer to each other are one.
constexpr double same_configuration = 1e-4;

/// From one pose to the other: position, and rotation about an axis.
Vector6 difference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  Vector6 result;
  result.head<3>() = to.translation() - from.translation();
  Eigen::Quaterniond turn(to.linear() * from.linear().transpose());
  if (turn.w() < 0)
    turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  // For small angles the sine of the half angle is the half angle.
  const double factor = sine < 1e-12 ? 2 : 2 * std::atan2(sine, turn.w()) / sine;
  result.tail<3>() = factor * turn.vec();
  return result;
}

class Descent {
public:
  Descent(const ArmModel& arm, const KinematicChain& chain, const Pose& tool,
          const DampedLeastSquaresOptions& options)
    : chain_(chain), target_(to_isometry(tool)), options_(options) {
    for (auto index : moving_joints(arm))
      limits_.emplace_back(arm.joints[index].lower, arm.joints[index].upper);
  }

  /// Whether `configuration` became a solution.
  bool run(Configuration& configuration) {
    double damping = 1e-3;
    auto off = difference(chain_.tool(configuration, jacobian_), target_);
    for (int i = 0; i < options_.max_iterations && !is_solved(off); ++i) {
      const auto next = step(configuration, off, damping);
      const auto next_off = difference(chain_.tool(next), target_);
      if (next_off.squaredNorm() < off.squaredNorm()) {
        configuration = next;
        off = difference(chain_.tool(configuration, jacobian_), target_);
        damping = std::max(damping / 10, least_damping);
      } else if ((damping *= 10) > most_damping)
        break;
    }
    return is_solved(off);
  }

  Configuration random_configuration(std::mt19937& random) const {
    Configuration result;
    for (const auto& [lower, upper] : limits_)
      result.push_back(std::uniform_real_distribution(lower, upper)(random));
    return result;
  }

private:
  bool is_solved(const Vector6& off) const {
    return off.head<3>().norm() < options_.tolerance && off.tail<3>().norm() < options_.tolerance;
  }

  /// A damped step within the limits: joints at a limit that it leads beyond stand still.
  Configuration step(const Configuration& from, const Vector6& off, double damping) const {
    auto jacobian = jacobian_;
    Eigen::VectorXd change;
    for (bool is_free = false; !is_free;) {
      Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
      normal.diagonal().array() += damping;
      change = normal.ldlt().solve(jacobian.transpose() * off);
      is_free = true;
      for (std::size_t i = 0; i < from.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const bool leads_beyond = (from[i] <= limits_[i].first && change[column] < 0) ||
                                  (from[i] >= limits_[i].second && change[column] > 0);
        if (leads_beyond && !jacobian.col(column).isZero(0)) {
          jacobian.col(column).setZero();
          is_free = false;
        }
      }
    }
    auto result = from;
    for (std::size_t i = 0; i < from.size(); ++i)
      result[i] = std::clamp(from[i] + change[static_cast<Eigen::Index>(i)], limits_[i].first,
                             limits_[i].second);
    return result;
  }

  const KinematicChain& chain_;
  Eigen::Isometry3d target_;
  const DampedLeastSquaresOptions& options_;
  std::vector<std::pair<double, double>> limits_;
  KinematicChain::Jacobian jacobian_;
};

} // namespace

std::vector<Configuration> solve_damped_least_squares(const ArmModel& arm,
                                                      const KinematicChain& chain, const Pose& tool,
                                                      const Configuration& start,
                                                      std::size_t wanted,
                                                      const DampedLeastSquaresOptions& options) {
  Descent descent(arm, chain, tool, options);
  std::mt19937 random(options.seed);
  std::vector<Configuration> result;
  for (int i = 0; i < options.max_starts && result.size() < wanted; ++i) {
    auto configuration = i == 0 ? start : descent.random_configuration(random);
    if (descent.run(configuration) && std::ranges::none_of(result, [&](const auto& other) {
          return distance(other, configuration) < same_configuration;
        }))
      result.push_back(configuration);
  }
  return result;
}

} // namespace castor::manipulation
