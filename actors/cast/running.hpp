#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/base/diagnostic.hpp"

#include <cstddef>
#include <string>
#include <vector>

/// Changes of a system that runs.
namespace castor::cast {

/// Adds to `running` what a file describes that was read with the names of the running
/// subarchitectures (`ParseOptions`): whole subarchitectures, and components of those that run. The
/// new components get numbers from `next_number` on, which no component ever had.
///
/// Returns what stands in the way; then nothing is added.
std::vector<Diagnostic> join(ArchitectureDescription& running, ArchitectureDescription added,
                             std::size_t& next_number);

struct Removal {
  /// What goes, working memories left out: in the order in which it is to be stopped.
  std::vector<std::string> components;
  /// Why nothing can be removed; empty if it can.
  std::string problem;
};

/// Takes a component, or a subarchitecture with all it consists of, out of `running`.
Removal remove(ArchitectureDescription& running, const std::string& name);

} // namespace castor::cast
