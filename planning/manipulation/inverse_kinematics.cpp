#include "castor/planning/manipulation/inverse_kinematics.hpp"

#include "castor/planning/manipulation/closed_form_kinematics.hpp"
#include "castor/planning/manipulation/kinematic_chain.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <algorithm>
#include <optional>

namespace castor::manipulation {

namespace {

// Candidates that are nearer to each other are one, as where the arm is stretched out.
constexpr double same_solution = 1e-9;

std::vector<Configuration> exact(const ClosedFormKinematics& closed_form, const Pose& tool) {
  std::vector<Configuration> result;
  for (auto& [configuration, is_within_limits, has_rotation] : closed_form.candidates(tool))
    if (is_within_limits && has_rotation &&
        std::ranges::none_of(result, [&configuration = configuration](const auto& other) {
          return distance(other, configuration) < same_solution;
        }))
      result.push_back(configuration);
  return result;
}

} // namespace

struct InverseKinematics::Solver {
  ArmModel arm;
  KinematicChain chain;
  std::optional<ClosedFormKinematics> closed_form;
  InverseKinematicsOptions options;
};

InverseKinematics::InverseKinematics(const ArmModel& arm, const InverseKinematicsOptions& options)
  : solver_(new Solver{arm, KinematicChain(arm), ClosedFormKinematics::of(arm), options}) {
  // nop
}

InverseKinematics::InverseKinematics(InverseKinematics&&) noexcept = default;
InverseKinematics& InverseKinematics::operator=(InverseKinematics&&) noexcept = default;
InverseKinematics::~InverseKinematics() = default;

bool InverseKinematics::is_closed_form() const {
  return solver_->closed_form.has_value();
}

std::vector<Configuration> InverseKinematics::solve(const Pose& tool,
                                                    const Configuration& near) const {
  const auto& [arm, chain, closed_form, options] = *solver_;
  chain.check(near);
  auto result = closed_form ? exact(*closed_form, tool)
                            : solve_damped_least_squares(arm, chain, tool, near, options.wanted,
                                                         options.descent);
  std::ranges::sort(result, {}, [&](const auto& x) { return distance(x, near); });
  return result;
}

} // namespace castor::manipulation
