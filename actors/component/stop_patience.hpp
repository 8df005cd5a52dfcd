#pragma once

#include <chrono>

namespace castor {

/// How long a component may take to stop, if neither its `--shutdown` nor the options of its system
/// say otherwise.
inline constexpr std::chrono::milliseconds standard_stop_patience{5000};

} // namespace castor
