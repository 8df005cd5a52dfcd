#pragma once

#include "castor/wm/timestamp.hpp"

#include <string>

namespace castor::faults {

/// For people: three digits and a unit, "236 ms", "31.4 s".
std::string rounded(Timestamp x);

} // namespace castor::faults
