#pragma once

#include "castor/actors/cast/description.hpp"

#include <string>

namespace castor::cast {

/// The description as a `.cast` file without variables, conditions and includes, which parses to
/// the same description. Every component line has its host.
std::string to_cast(const ArchitectureDescription& architecture);

} // namespace castor::cast
