#pragma once

#include "castor/actors/component/commands_from_seat.hpp"
#include "castor/mapping/body/types.hpp"

#include <string>

namespace castor::mapping {

/// A component that commands a robot, in its seat if there is one.
class Drives : public CommandsFromSeat<DriverSeat> {
protected:
  /// Does not wait for the robot.
  void drive(const Twist2& velocity) { command_from_seat(robot_.get(), DriveCommand{velocity}); }

  /// Whose pushes count.
  const std::string& sensors() const { return sensors_->empty() ? robot_.get() : sensors_.get(); }

  Option<StandaloneName> robot_{this, "robot", "robot", "the robot to drive"};
  Option<StandaloneName> sensors_{
    this, "sensors", "",
    "whose pushes count, if another component takes the commands; empty: the robot"};
};

} // namespace castor::mapping
