#pragma once

#include "castor/wm/clock/time_control.hpp"

#include <optional>
#include <string>

namespace castor::cli {

/// Parses the pace of simulated time, "max", "paused" or a factor of real time such as "10";
/// nothing for an empty text.
std::optional<Pace> pace(const std::string& text);

/// For CLI11's `check`: an error message, or empty if the text is a pace.
std::string check_pace(const std::string& text);

} // namespace castor::cli
