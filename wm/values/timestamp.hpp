#pragma once

#include <chrono>

namespace castor {

/// Time since the system began.
using Timestamp = std::chrono::microseconds;

} // namespace castor
