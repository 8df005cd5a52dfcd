#pragma once

#include <cstdint>

namespace castor {

/// Number of a timer of a component.
enum class TimerId : std::uint32_t {};

} // namespace castor
