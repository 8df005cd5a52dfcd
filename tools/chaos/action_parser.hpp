#pragma once

#include "castor/tools/chaos/workload.hpp"

#include <string_view>
#include <vector>

namespace castor::faults {

/// Reads what a statement of a workload says behind its trigger: an action, or several with `or`
/// between them. Throws StatementError.
std::vector<Action> parse_actions(std::string_view text);

/// Reads `same TYPE, ... [but for FIELD, ...]` behind its first word. Throws StatementError.
SameEntries parse_same(std::string_view text);

/// Reads `expect answer within TIME` behind its first word. Throws StatementError.
Timestamp parse_expectation(std::string_view text);

} // namespace castor::faults
