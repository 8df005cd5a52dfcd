#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>

/// Entry types of those who watch people.
namespace castor::mapping {

/// Entry: somebody whom the robot sees, in the map frame. Its id is "person-N"; deleted when the
/// person has been out of sight for some time.
struct Person {
  /// Stays the same as long as the person is followed.
  std::int64_t id = 0;
  /// When that was, microseconds since the system began.
  std::int64_t time = 0;
  /// Metres.
  double x = 0;
  double y = 0;
  /// Direction of walking, radians; of somebody who stands, the last one.
  double heading = 0;
  /// m/s.
  double speed = 0;
  /// Share of the last scans in which the person was seen, 0 to 1.
  double visibility = 0;

  friend bool operator==(const Person&, const Person&) = default;
};

CASTOR_REFLECT(Person, id, time, x, y, heading, speed, visibility)

} // namespace castor::mapping
