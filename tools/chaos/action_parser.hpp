#pragma once

#include "castor/tools/chaos/workload.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace castor::faults {

/// `expect answer within TIME` or `expect rest within TIME`.
struct Expectation {
  enum class Kind { answer, rest, growth };

  Kind kind = Kind::answer;
  /// Above 0; of an answer and of rest.
  Timestamp within{0};
  /// Above 0; of growth.
  std::uint64_t bytes = 0;
};

/// Parses the part of a workload statement after its trigger: an action, or several with `or`
/// between them. Throws StatementError.
std::vector<Action> parse_actions(std::string_view text);

/// Parses `same TYPE, ... [but for FIELD, ...]` after its first word. Throws StatementError.
SameEntries parse_same(std::string_view text);

/// Parses an expectation after its first word. Throws StatementError.
Expectation parse_expectation(std::string_view text);

} // namespace castor::faults
