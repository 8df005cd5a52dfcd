#pragma once

#include "castor/tools/chaos/draw.hpp"
#include "castor/tools/chaos/fault_plan.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace castor::faults {

/// A fault that is due, with its target.
struct DueFault {
  /// Since the start of the system.
  Timestamp at{0};
  Fault fault;
  /// Index of its statement in the plan.
  std::size_t statement = 0;

  friend bool operator==(const DueFault&, const DueFault&) = default;
};

/// The faults of a plan in order of time. Kind, time and target are determined by plan, targets,
/// seed and duration, and for statements triggered by changes also by the changes.
///
/// What is drawn for a statement does not depend on other statements, except on identical ones
/// before it.
class FaultSchedule {
public:
  /// No timed fault comes at or after the end of `duration`. The plan must have been checked
  /// against the targets: throws std::invalid_argument if there is no possible target, and
  /// std::length_error if a statement results in too many faults.
  FaultSchedule(const FaultPlan& plan, FaultTargets targets, std::uint64_t seed,
                Timestamp duration);

  /// All timed faults in order of time; those at one time in the order of the plan.
  const std::vector<DueFault>& timed() const { return timed_; }

  /// Time of the next timed fault.
  std::optional<Timestamp> next_time() const;

  /// The next timed fault that is due, if there is one; each is returned once.
  std::optional<DueFault> next(Timestamp now);

  /// Called for a change that matches a filter, given by its index in `watched_by`. Returns the
  /// fault that it triggers, if any.
  std::optional<DueFault> on_change(std::size_t filter, Timestamp now);

  /// The same faults as a plan without random choices, except in statements `after every N`
  /// changes. With the same seed its schedule is this one.
  FaultPlan as_plan() const;

private:
  /// A statement triggered by changes.
  struct Watch {
    std::size_t statement = 0;
    After after;
    std::uint32_t seen = 0;
    std::uint64_t drawn = 0;
    bool over = false;
  };

  Fault draw(std::size_t statement, std::uint64_t number) const;

  FaultPlan plan_;
  FaultTargets targets_;
  std::uint64_t seed_;
  /// For each statement: its text, and the number of identical ones before it.
  std::vector<std::string> purposes_;
  std::vector<DueFault> timed_;
  std::size_t next_ = 0;
  std::vector<Watch> watches_;
};

} // namespace castor::faults
