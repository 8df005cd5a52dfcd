#pragma once

#include "castor/base/injected_fault.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>

namespace castor {

/// A fault injected into a journal: it behaves as on a full or a slow disk.
struct JournalFault {
  enum class Kind : std::uint8_t {
    /// The next write fails.
    failure,
    /// Every write takes `by` longer.
    slowness,
  };

  Kind kind = Kind::failure;
  Timestamp duration{0};
  Timestamp by{0};
  FaultTicket ticket = {};
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::JournalFault)
