#pragma once

#include "castor/tools/simulation/simulated_machines.hpp"

#include <cstddef>

namespace castor::simulation {

/// Reports to the recorder the entries that working memories lost when they ended: all, or those
/// that their journals lack. Returns how often one lost everything.
std::size_t note_losses(SystemWorld& world, const SimulatedMachines& machines);

} // namespace castor::simulation
