#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::planning::test {

/// A desk with a ball, and a robot that puts it left or right, and has a battery.
struct Desk {
  std::string ball = "middle";
  bool is_charged = false;
  /// Since the battery was charged.
  std::int32_t puts = 0;
  /// Steps that were executed to their end.
  std::vector<std::string> log;
  /// Steps that had already been done when they were executed.
  std::int32_t needless = 0;
};
CASTOR_REFLECT(Desk, ball, is_charged, puts, log, needless)

} // namespace castor::planning::test
