#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string_view>

namespace castor {

enum class JournalMode : std::uint8_t {
  off,
  /// Acknowledged changes are on disk.
  full,
  /// Acknowledged changes are on disk a little later; a crash may lose the last of them.
  batched,
};

CASTOR_REFLECT_ENUM(JournalMode, off, full, batched)

std::string_view to_string(JournalMode x);

} // namespace castor
