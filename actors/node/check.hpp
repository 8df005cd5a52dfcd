#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/diagnostic.hpp"

#include <vector>

namespace castor {

/// What stands in the way of running a system that was read without errors: classes that do not
/// exist or do not belong where they stand, options that they do not have or that are no such
/// values, hosts that are not this machine. Loads the libraries that the classes are in.
std::vector<cast::Diagnostic> check_classes(const ArchitectureDescription& architecture);

} // namespace castor
