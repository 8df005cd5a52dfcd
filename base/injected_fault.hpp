#pragma once

#include "castor/base/caf.hpp"

#include <cstdint>

namespace castor {

/// Number of an injected fault, and the actor that is notified when it takes effect.
struct FaultTicket {
  std::uint64_t number = 0;
  /// May be null.
  caf::actor observer = {};
};

/// Message to the observer: the fault has taken effect for the first time.
struct FaultHappened {
  std::uint64_t number = 0;
};

/// Sends FaultHappened to the observer, on the first call only.
void report_effect(FaultTicket& x);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::FaultHappened)
