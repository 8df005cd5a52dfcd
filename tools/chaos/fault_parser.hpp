#pragma once

#include "castor/tools/chaos/fault.hpp"

#include <string_view>
#include <vector>

namespace castor::faults {

/// Reads what a statement says behind its trigger: a fault, or several with `or` between them.
/// Throws StatementError.
std::vector<Fault> parse_faults(std::string_view text);

} // namespace castor::faults
