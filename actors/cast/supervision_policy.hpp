#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

/// Handling of failures, in the terms of Erlang/OTP.
namespace castor {

/// Children that a supervisor starts again when one of them has failed.
enum class RestartStrategy : std::uint8_t {
  /// The failed child.
  one_for_one,
  /// All children.
  one_for_all,
  /// The failed child, and those that were started after it.
  rest_for_one,
};

/// The keyword of the .cast language.
std::string_view to_string(RestartStrategy x) noexcept;

/// How a supervisor deals with its children's failures.
struct SupervisionPolicy {
  RestartStrategy strategy = RestartStrategy::one_for_one;
  /// Most restarts within the period: beyond that, the supervisor ends its children and fails
  /// itself.
  std::uint32_t restarts = 3;
  std::chrono::milliseconds period{10'000};
  /// Delay of the second restart of a child within the period; doubled for each further one. The
  /// first restart is immediate.
  std::chrono::milliseconds first_delay{100};
  std::chrono::milliseconds longest_delay{5000};

  friend bool operator==(const SupervisionPolicy&, const SupervisionPolicy&) = default;
};

} // namespace castor
