#pragma once

#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace castor::faults {

/// Three digits and a unit: "236 ms", "31.4 s".
std::string rounded(Timestamp x);

/// "1 entry", "3 entries".
std::string counted(std::size_t n, std::string_view one, std::string_view several);

} // namespace castor::faults
