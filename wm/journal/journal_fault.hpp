#pragma once

#include "castor/base/injected_fault.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>

namespace castor {

/// A fault injected into a journal, as a disk that is full or slow would.
struct JournalFault {
  enum class Kind : std::uint8_t {
    /// Nothing can be written: the journal fails at the next write.
    failure,
    /// Every write takes longer, by `by`.
    slowness,
  };

  Kind kind = Kind::failure;
  Timestamp duration{0};
  Timestamp by{0};
  FaultTicket ticket = {};
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::JournalFault)
