#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/diagnostic.hpp"

#include <vector>

namespace castor {

/// Adds what stands in the way of running a component in this process: a class that does not exist
/// or does not belong where it stands, options that it does not have or that are no such values.
/// Loads the library that the class is in.
void check_class(const ComponentDescription& x, std::vector<cast::Diagnostic>& problems);

/// The same for all components of a system.
std::vector<cast::Diagnostic> check_classes(const ArchitectureDescription& architecture);

} // namespace castor
