#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace castor {

/// How long a system is to run.
struct RunLimits {
  /// Nothing: no limit.
  std::optional<std::chrono::nanoseconds> at_most = {};
  /// Until nothing was changed and nobody was busy for so long.
  std::optional<std::chrono::nanoseconds> quiet = {};
};

/// Why `System::wait` returned.
enum class EndReason : std::uint8_t {
  ended_by_component,
  time_over,
  quiet,
  interrupted,
  all_failed
};

} // namespace castor
