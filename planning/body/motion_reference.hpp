#pragma once

#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <cstdint>

namespace castor::manipulation {

/// Where the joints ought to be, as ArmCommands say: goes along a motion in its own time, and comes
/// to rest on it when there are no more commands, or before the part of it that is known ends.
class MotionReference {
public:
  /// @param start of the arm, which rests there
  /// @param stop_time seconds from full speed to rest
  MotionReference(Configuration start, double stop_time);

  /// Takes over the part of the motion that comes next. If it is another motion than before, it
  /// begins at the first configuration, at rest.
  /// \throws std::invalid_argument if there is not one number for each joint, or nothing.
  void follow(const ArmCommand& command);

  /// Goes on by `seconds`; on towards full speed, or towards rest.
  void advance(double seconds, bool goes_on);

  /// Stands, where the arm is. The motion is over.
  void stay(const Configuration& at);

  Configuration position() const;

  /// Number of the motion, 0 for none, and the time on it.
  std::int64_t motion() const { return command_.motion; }
  double time() const { return time_; }

  /// Share of full speed, 0 to 1.
  double rate() const { return rate_; }

private:
  std::size_t samples() const;
  double end() const;
  double sample(std::ptrdiff_t index, std::size_t joint) const;

  std::size_t joints_;
  double stop_time_;
  ArmCommand command_;
  double time_ = 0;
  double rate_ = 0;
};

} // namespace castor::manipulation
