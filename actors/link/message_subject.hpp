#pragma once

#include "castor/actors/link/wire_members.hpp"

#include <cstdint>

namespace castor {

/// Kind of a message between processes: its first byte.
enum class MessageSubject : std::uint8_t {
  /// For an actor: sender, receiver, CAF's message id, the message.
  message,
  /// The same with an error, which answers a request.
  error,
  /// An actor is to end.
  exit,
  /// An actor has ended.
  ended,
  /// Descriptors of types that later messages refer to.
  types,
  /// One of the others, with the sender's simulated time before it.
  timed,
};
CASTOR_WIRE_ENUM(MessageSubject, timed)

} // namespace castor
