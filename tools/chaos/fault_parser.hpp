#pragma once

#include "castor/tools/chaos/fault.hpp"

#include <string_view>
#include <vector>

namespace castor::faults {

/// Parses the part of a statement after its trigger: a fault, or several with `or` between them.
/// Throws StatementError.
std::vector<Fault> parse_faults(std::string_view text);

} // namespace castor::faults
