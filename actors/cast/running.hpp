#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/base/diagnostic.hpp"

#include <cstddef>
#include <string>
#include <vector>

/// Changes of a running system.
namespace castor::cast {

/// Adds the content of a file to `running`: whole subarchitectures, and components of running ones.
/// The file was read with the names of the running subarchitectures (`ParseOptions`). The new
/// components get numbers from `next_number` on, which no component ever had.
///
/// Returns the problems; if there are any, nothing is added.
std::vector<Diagnostic> join(ArchitectureDescription& running, ArchitectureDescription added,
                             std::size_t& next_number);

struct Removal {
  /// Components to remove, without working memories, in the order in which to stop them.
  std::vector<std::string> components;
  /// Why nothing can be removed; empty if it can.
  std::string problem;
};

/// Takes a component, or a subarchitecture with all it consists of, out of `running`.
Removal remove(ArchitectureDescription& running, const std::string& name);

} // namespace castor::cast
