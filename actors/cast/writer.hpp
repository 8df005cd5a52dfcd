#pragma once

#include "castor/actors/cast/description.hpp"

#include <string>

namespace castor::cast {

/// The description as a `.cast` file without variables, conditions and includes, which is read as
/// the same description. Hosts stand at every line.
std::string to_cast(const ArchitectureDescription& architecture);

} // namespace castor::cast
