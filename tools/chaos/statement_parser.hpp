#pragma once

#include "castor/tools/chaos/fault_plan.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace castor::faults {

/// Nothing if the line is not about the seed. Throws StatementError if that is no number.
std::optional<std::uint64_t> parse_seed(std::string_view line);

/// Cuts off when something is to happen, with which a line begins. Throws StatementError.
Trigger parse_trigger(std::string_view& rest);

/// Throws StatementError. The statement does not know where it stands.
Statement parse_statement(std::string_view line);

} // namespace castor::faults
