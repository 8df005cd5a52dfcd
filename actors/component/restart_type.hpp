#pragma once

#include <cstdint>

namespace castor {

/// Whether a component is started again.
enum class RestartType : std::uint8_t {
  /// Whenever it has ended.
  permanent,
  /// If it has failed.
  transient,
  /// Never.
  temporary,
};

} // namespace castor
