#pragma once

#include "castor/tools/chaos/fault_plan.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace castor::faults {

/// Parses a `seed` line; nothing for any other line. Throws StatementError if the seed is not a
/// number.
std::optional<std::uint64_t> parse_seed(std::string_view line);

/// Parses the trigger at the beginning of a line and removes it from `rest`. Throws StatementError.
Trigger parse_trigger(std::string_view& rest);

/// Throws StatementError. Leaves the statement's location empty.
Statement parse_statement(std::string_view line);

} // namespace castor::faults
