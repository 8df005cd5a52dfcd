#pragma once

#include "castor/benchmarks/manipulation/physics/physics_model.hpp"
#include "castor/planning/manipulation/manipulation_plan.hpp"

#include <memory>
#include <set>
#include <string>

namespace castor::manipulation {

/// An arm at a table in MuJoCo, with masses, friction and contact forces. Its joints follow where
/// they are to be like those of an arm with stiff motors whose weight is compensated; fingers press
/// with a bounded force.
class PhysicalTable {
public:
  /// All things have come to rest.
  /// \throws std::invalid_argument as `physics_model` does, and std::runtime_error if MuJoCo does
  /// not take the model.
  PhysicalTable(const ArmModel& arm, const Scene& scene, const Configuration& start,
                const PhysicsOptions& options = {});
  PhysicalTable(PhysicalTable&&) noexcept;
  PhysicalTable& operator=(PhysicalTable&&) noexcept;
  ~PhysicalTable();

  /// Lets the arm carry out a stage, until joints and fingers are at rest.
  void carry_out(const MotionStage& stage);

  Configuration positions() const;

  /// Distance of the fingers, metres.
  double opening() const;

  /// In the arm's frame.
  /// \throws std::invalid_argument if there is none of this name.
  Pose pose_of(const std::string& thing) const;

  /// What links, other than the fingers, have touched so far.
  const std::set<std::string>& touched() const;

  /// How far a joint was from where it was to be, at most, radians.
  double most_lag() const;

private:
  class Simulation;
  std::unique_ptr<Simulation> simulation_;
};

} // namespace castor::manipulation
