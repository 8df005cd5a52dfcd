#pragma once

#include "castor/planning/body/arm_body.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace castor::manipulation {

/// A state and when it was saved, microseconds since the system began.
struct TimedArm {
  std::int64_t time = 0;
  SavedArm state;
};

/// Some lines of text, without loss but for the solids of things.
std::string saved_arm_text(const TimedArm& x);

/// Nothing if these are no such lines.
std::optional<TimedArm> parse_saved_arm(std::string_view text);

} // namespace castor::manipulation
