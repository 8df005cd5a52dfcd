#pragma once

#include "castor/actors/faults/fault_plan.hpp"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace castor::faults {

/// A line that is no statement.
class StatementError : public std::runtime_error {
public:
  StatementError(const std::string& what, std::string remedy)
    : runtime_error(what), remedy_(std::move(remedy)) {}

  /// What to write instead.
  const std::string& remedy() const { return remedy_; }

private:
  std::string remedy_;
};

/// Nothing if the line is not about the seed. Throws StatementError if that is no number.
std::optional<std::uint64_t> parse_seed(std::string_view line);

/// Throws StatementError. The statement does not know where it stands.
Statement parse_statement(std::string_view line);

} // namespace castor::faults
