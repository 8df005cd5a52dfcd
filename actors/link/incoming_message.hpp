#pragma once

#include "castor/actors/link/received_content.hpp"

#include <cstdint>
#include <vector>

namespace castor {

/// A message from another process.
struct IncomingMessage {
  Bytes head;
  std::vector<ReceivedContentPtr> contents;
  /// Size in bytes of a message that exceeds the limit, otherwise 0. Its contents are dropped then,
  /// and so is its head if that alone was too large to be kept.
  std::uint64_t too_large = 0;
};

} // namespace castor
