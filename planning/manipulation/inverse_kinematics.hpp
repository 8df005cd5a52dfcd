#pragma once

#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/damped_least_squares.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace castor::manipulation {

struct InverseKinematicsOptions {
  /// How many solutions are looked for where there is no closed form.
  std::size_t wanted = 4;
  DampedLeastSquaresOptions descent;
};

/// Configurations that bring the tool to a pose: all of them in closed form for arms like the
/// Katana (ClosedFormKinematics), some of them by damped least squares for others.
class InverseKinematics {
public:
  explicit InverseKinematics(const ArmModel& arm, const InverseKinematicsOptions& options = {});
  InverseKinematics(InverseKinematics&&) noexcept;
  InverseKinematics& operator=(InverseKinematics&&) noexcept;
  ~InverseKinematics();

  bool is_closed_form() const;

  /// Solutions within the limits for a pose in the arm's frame, the nearest to `near` first; empty
  /// if none is found. An arm of less than six joints reaches few poses exactly. A roll that stands
  /// still may leave the tool turned about its own axis, by up to 5 degrees in closed form.
  /// \throws std::invalid_argument if `near` is no configuration of this arm.
  std::vector<Configuration> solve(const Pose& tool, const Configuration& near) const;

private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

} // namespace castor::manipulation
