#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace castor::faults {

/// A lifecycle event of a component or process.
struct LifeNote {
  enum class Kind : std::uint8_t { down, up, first_callback, escalated };

  Timestamp at{0};
  std::string target;
  Kind kind = Kind::down;
  /// For `down`: the reason.
  std::string reason;
};

/// The outages that result from notes, which are in order of time. A second `down` without an `up`
/// in between continues the same outage.
/// @param bound_of longest time that a component may be down
std::vector<Outage> outages_of(std::span<const LifeNote> notes,
                               const std::function<Timestamp(const std::string&)>& bound_of);

/// One line for each component that was neither back nor given up within its bound. Outages whose
/// bound ends after `end` are not judged.
std::vector<std::string> late_recoveries(std::span<const Outage> outages, Timestamp end);

} // namespace castor::faults
