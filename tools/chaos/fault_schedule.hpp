#pragma once

#include "castor/tools/chaos/draw.hpp"
#include "castor/tools/chaos/fault_plan.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace castor::faults {

/// A fault that is to happen now, and to whom.
struct DueFault {
  /// Since the system has started.
  Timestamp at{0};
  Fault fault;
  /// Which statement of the plan it comes from.
  std::size_t statement = 0;

  friend bool operator==(const DueFault&, const DueFault&) = default;
};

/// The faults of a plan, one after the other. Which, when and to whom follows from plan, targets,
/// seed and duration, and for those after changes from which changes there are.
///
/// What is drawn for a statement depends on no other statement, unless one is written like it.
class FaultSchedule {
public:
  /// No fault by time comes at or after the end of `duration`. The plan must have been checked
  /// against the targets: throws std::invalid_argument if there is nothing to draw from, and
  /// std::length_error if a statement comes to more faults than anybody could make sense of.
  FaultSchedule(const FaultPlan& plan, FaultTargets targets, std::uint64_t seed,
                Timestamp duration);

  /// All that come by time, in order; those at one time in the order of the plan.
  const std::vector<DueFault>& timed() const { return timed_; }

  /// When the next by time is due.
  std::optional<Timestamp> next_time() const;

  /// The next by time that is due, if there is one; each is given once.
  std::optional<DueFault> next(Timestamp now);

  /// There was a change that a filter wants: its place among those that the plan watches
  /// (`watched_by`). The fault that happens because of it, if there is one.
  std::optional<DueFault> on_change(std::size_t filter, Timestamp now);

  /// The same faults as a plan in which nothing is drawn any more, but for those after every so
  /// many changes. With the same seed its schedule is this one.
  FaultPlan as_plan() const;

private:
  /// A statement whose faults come after changes.
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
  /// Of each statement: its text, and how many like it come before.
  std::vector<std::string> purposes_;
  std::vector<DueFault> timed_;
  std::size_t next_ = 0;
  std::vector<Watch> watches_;
};

} // namespace castor::faults
