#pragma once

#include "castor/actors/cast/description.hpp"

#include <chrono>
#include <cstddef>

namespace castor::simulation {

/// Three subarchitectures, `a`, `b` and `c`, each with a task manager and two components.
///
/// @param strategy one of the three that there are
/// @param escalates whether a few restarts already take the whole subarchitecture along
/// @param moves whether some components may run elsewhere when their node is lost
const ArchitectureDescription& simulated_architecture(std::chrono::milliseconds lease,
                                                      std::size_t strategy, bool escalates,
                                                      bool moves);

} // namespace castor::simulation
