#include "castor/mapping/slam/pose_graph.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <stdexcept>
#include <string>

namespace castor::mapping {

namespace {

using Block = std::array<double, 3>;

template <class T>
T within_a_turn(const T& angle) {
  const T turn(2 * std::numbers::pi);
  return angle - turn * ceil((angle - T(std::numbers::pi)) / turn);
}

// A pose whose third number is an angle.
struct PoseManifold {
  template <class T>
  bool Plus(const T* x, const T* delta, T* result) const {
    result[0] = x[0] + delta[0];
    result[1] = x[1] + delta[1];
    result[2] = within_a_turn(T(x[2] + delta[2]));
    return true;
  }
  template <class T>
  bool Minus(const T* y, const T* x, T* delta) const {
    delta[0] = y[0] - x[0];
    delta[1] = y[1] - x[1];
    delta[2] = within_a_turn(T(y[2] - x[2]));
    return true;
  }
};

// The measured pose of one keyframe on another, in standard deviations.
struct RelativePose {
  Pose2 measured;
  Eigen::Matrix3d root;

  template <class T>
  bool operator()(const T* from, const T* to, T* residual) const {
    using std::cos;
    using std::sin;
    T c = cos(from[2]);
    T s = sin(from[2]);
    T dx = to[0] - from[0];
    T dy = to[1] - from[1];
    Eigen::Matrix<T, 3, 1> off;
    off << c * dx + s * dy - measured.x, c * dy - s * dx - measured.y,
      within_a_turn(T(to[2] - from[2] - measured.heading));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} = root.cast<T>() * off;
    return true;
  }
};

// L^T of the information matrix L L^T.
Eigen::Matrix3d information_root(const PoseCovariance& c) {
  Eigen::Matrix3d covariance;
  covariance << c.xx, c.xy, c.x_heading, c.xy, c.yy, c.y_heading, c.x_heading, c.y_heading,
    c.heading;
  Eigen::LLT<Eigen::Matrix3d> is_positive(covariance);
  if (is_positive.info() != Eigen::Success)
    throw std::invalid_argument("the covariance of a constraint is not positive definite");
  return covariance.inverse().llt().matrixL().transpose();
}

} // namespace

struct PoseGraph::Problem {
  PoseGraphOptions options;
  // Addresses do not move.
  std::deque<Block> poses;
  ceres::Problem problem;
  struct Loop {
    std::int64_t from;
    std::int64_t to;
    RelativePose cost;
  };
  std::vector<Loop> loops;

  void add_block(const Pose2& x) {
    auto& block = poses.emplace_back(Block{x.x, x.y, x.heading});
    problem.AddParameterBlock(block.data(), 3, new ceres::AutoDiffManifold<PoseManifold, 3, 3>);
    if (poses.size() == 1)
      problem.SetParameterBlockConstant(block.data());
  }

  Block& block(std::int64_t number) {
    if (number < 0 || number >= static_cast<std::int64_t>(poses.size()))
      throw std::out_of_range("the pose graph has no keyframe " + std::to_string(number));
    return poses[static_cast<std::size_t>(number)];
  }
};

PoseGraph::PoseGraph(const PoseGraphOptions& options) : problem_(std::make_unique<Problem>()) {
  problem_->options = options;
}

PoseGraph::PoseGraph(PoseGraph&&) noexcept = default;
PoseGraph& PoseGraph::operator=(PoseGraph&&) noexcept = default;
PoseGraph::~PoseGraph() = default;

void PoseGraph::add_pose(const Pose2& pose) {
  problem_->add_block(pose);
}

void PoseGraph::add_pose(const Constraint& constraint) {
  if (constraint.to != static_cast<std::int64_t>(size()))
    throw std::out_of_range("the next keyframe of the pose graph is " + std::to_string(size()) +
                            ", and not " + std::to_string(constraint.to));
  problem_->block(constraint.from);
  information_root(constraint.covariance);
  problem_->add_block(compose(pose(constraint.from), constraint.pose));
  add(constraint);
}

void PoseGraph::add(const Constraint& x) {
  auto& from = problem_->block(x.from);
  auto& to = problem_->block(x.to);
  if (x.from == x.to)
    throw std::invalid_argument("a constraint from keyframe " + std::to_string(x.from) +
                                " to itself");
  RelativePose cost{x.pose, information_root(x.covariance)};
  ceres::LossFunction* loss = nullptr;
  if (x.kind == ConstraintKind::loop) {
    problem_->loops.push_back({x.from, x.to, cost});
    loss = new ceres::CauchyLoss(problem_->options.robust_from);
  }
  problem_->problem.AddResidualBlock(
    new ceres::AutoDiffCostFunction<RelativePose, 3, 3, 3>(new RelativePose(cost)), loss,
    from.data(), to.data());
}

void PoseGraph::move(std::int64_t number, const Pose2& pose) {
  problem_->block(number) = {pose.x, pose.y, pose.heading};
}

bool PoseGraph::solve() {
  if (size() < 2)
    return true;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = problem_->options.max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_->problem, &summary);
  return summary.IsSolutionUsable();
}

std::size_t PoseGraph::size() const {
  return problem_->poses.size();
}

Pose2 PoseGraph::pose(std::int64_t number) const {
  const auto& x = problem_->block(number);
  return {x[0], x[1], x[2]};
}

std::vector<Pose2> PoseGraph::poses() const {
  std::vector<Pose2> result;
  result.reserve(size());
  for (const auto& x : problem_->poses)
    result.push_back({x[0], x[1], x[2]});
  return result;
}

std::size_t PoseGraph::loops() const {
  return problem_->loops.size();
}

std::size_t PoseGraph::doubted_loops() const {
  std::size_t result = 0;
  for (const auto& x : problem_->loops) {
    Eigen::Vector3d residual;
    x.cost(problem_->block(x.from).data(), problem_->block(x.to).data(), residual.data());
    if (residual.norm() > 3 * std::sqrt(3.))
      ++result;
  }
  return result;
}

PoseCovariance PoseGraph::covariance(std::int64_t number) const {
  const auto& block = problem_->block(number);
  if (number == 0)
    return {};
  ceres::Covariance covariance{ceres::Covariance::Options()};
  std::vector<std::pair<const double*, const double*>> wanted{{block.data(), block.data()}};
  std::array<double, 9> c{};
  if (!covariance.Compute(wanted, &problem_->problem) ||
      !covariance.GetCovarianceBlockInTangentSpace(block.data(), block.data(), c.data()))
    return {};
  return {c[0], c[1], c[2], c[4], c[5], c[8]};
}

} // namespace castor::mapping
