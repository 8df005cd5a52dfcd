#pragma once

#include "castor/tools/simulation/simulated_machines.hpp"

#include <cstddef>

namespace castor::simulation {

/// Tells the recorder that what working memories held when they ended is gone, or as much of it as
/// their journals lack. Returns how often one lost everything.
std::size_t note_losses(SystemWorld& world, const SimulatedMachines& machines);

} // namespace castor::simulation
