#pragma once

#include "castor/base/caf.hpp"

#include <cstdint>

namespace castor {

/// The number of an injected fault, and who is told when it takes effect.
struct FaultTicket {
  std::uint64_t number = 0;
  /// Null if nobody wants to know.
  caf::actor observer = {};
};

/// To the observer: the fault has taken effect for the first time.
struct FaultHappened {
  std::uint64_t number = 0;
};

/// Tells the observer that the fault has taken effect, once.
void report_effect(FaultTicket& x);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::FaultHappened)
