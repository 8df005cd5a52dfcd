#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace castor {

/// How long a system is to run.
struct RunLimits {
  /// No limit if there is no value.
  std::optional<std::chrono::nanoseconds> at_most = {};
  /// Time without changes, busy components, failures and restarts after which the run ends; of
  /// simulated time, without changes.
  std::optional<std::chrono::nanoseconds> quiet = {};
  /// Real time after which a run in simulated time ends, in case that time stands.
  std::optional<std::chrono::nanoseconds> at_most_real = {};
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
