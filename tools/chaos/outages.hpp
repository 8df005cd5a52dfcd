#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace castor::faults {

/// What was noticed of a component or process.
struct LifeNote {
  enum class Kind : std::uint8_t { down, up, first_callback, escalated };

  Timestamp at{0};
  std::string target;
  Kind kind = Kind::down;
  /// Of `down`: why.
  std::string reason;
};

/// The outages that notes, in order of time, come to. Who goes down once more before anybody saw it
/// up was down all the time.
/// @param bound_of how long a component may be down
std::vector<Outage> outages_of(std::span<const LifeNote> notes,
                               const std::function<Timestamp(const std::string&)>& bound_of);

/// One line for each component that was neither back nor given up within its bound, as far as the
/// run lasted long enough to tell.
std::vector<std::string> late_recoveries(std::span<const Outage> outages, Timestamp end);

} // namespace castor::faults
