#pragma once

#include "castor/base/caf.hpp"
#include "castor/base/injected_fault.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>

namespace castor {

/// An injected fault of a link, as seen from one of its ends.
struct LinkFault {
  enum class Kind : std::uint8_t {
    /// Nothing passes in either direction, and no error is reported.
    silence,
    /// Output is delayed.
    delay,
    /// Some messages are lost, and the connection with them.
    loss,
  };

  Kind kind = Kind::silence;
  Timestamp duration{0};
  /// For `delay`: by how much.
  Timestamp by{0};
  /// For `loss`: part of the messages that is lost, in millionths.
  std::uint32_t part = 0;
  FaultTicket ticket = {};
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkFault)
