#pragma once

#include "castor/base/caf.hpp"
#include "castor/base/injected_fault.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>

namespace castor {

/// An injected fault of a link, as seen from one of its ends.
struct LinkFault {
  enum class Kind : std::uint8_t {
    /// Nothing passes, either way, and nobody is told.
    silence,
    /// What is sent goes later.
    delay,
    /// Some of what is sent is lost, and with it the connection.
    loss,
  };

  Kind kind = Kind::silence;
  Timestamp duration{0};
  /// Of `delay`.
  Timestamp by{0};
  /// Of `loss`: the part of the messages, in millionths.
  std::uint32_t part = 0;
  FaultTicket ticket = {};
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkFault)
