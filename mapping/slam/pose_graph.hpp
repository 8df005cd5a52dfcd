#pragma once

#include "castor/mapping/slam/types.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace castor::mapping {

struct PoseGraphOptions {
  /// Deviations of loop constraints beyond this many standard deviations count less (Cauchy's
  /// loss).
  double robust_from = 1;
  int max_iterations = 30;
};

/// Poses of all keyframes by all constraints: nonlinear least squares (Ceres), from the last
/// estimate on. The first pose stands still. Without threads and clocks.
class PoseGraph {
public:
  explicit PoseGraph(const PoseGraphOptions& options = {});
  PoseGraph(PoseGraph&&) noexcept;
  PoseGraph& operator=(PoseGraph&&) noexcept;
  ~PoseGraph();

  /// Adds a keyframe at this pose, which gets the next number; the first stays at it.
  void add_pose(const Pose2& pose);

  /// Adds a keyframe where the constraint has it, which comes from one that is there.
  void add_pose(const Constraint& constraint);

  /// Adds an edge between keyframes that are there. Throws std::out_of_range for others, and
  /// std::invalid_argument if the covariance is that of no measurement.
  void add(const Constraint& constraint);

  /// Sets where `solve` begins for this keyframe. Throws std::out_of_range.
  void move(std::int64_t number, const Pose2& pose);

  /// Computes all poses anew. Returns whether the solver found a minimum.
  bool solve();

  std::size_t size() const;
  Pose2 pose(std::int64_t number) const;
  std::vector<Pose2> poses() const;

  std::size_t loops() const;
  /// Loop constraints that are at odds with the others: further off than three standard
  /// deviations in each number.
  std::size_t doubted_loops() const;

  /// Covariance of a pose in the frame of the first, by the constraints that there were when
  /// `solve` was called last; zero if it cannot be computed. Takes some ms.
  PoseCovariance covariance(std::int64_t number) const;

private:
  struct Problem;
  std::unique_ptr<Problem> problem_;
};

} // namespace castor::mapping
