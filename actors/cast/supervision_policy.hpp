#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

/// How failures are dealt with, in the words of Erlang/OTP.
namespace castor {

/// Whom a supervisor starts again when one of its children has failed.
enum class RestartStrategy : std::uint8_t {
  /// That one.
  one_for_one,
  /// All of them.
  one_for_all,
  /// That one, and those that were started after it.
  rest_for_one,
};

/// The word of the .cast language.
std::string_view to_string(RestartStrategy x) noexcept;

/// How a supervisor deals with its children's failures.
struct SupervisionPolicy {
  RestartStrategy strategy = RestartStrategy::one_for_one;
  /// If it would have to restart more often than this within the period, it ends its children and
  /// fails itself.
  std::uint32_t restarts = 3;
  std::chrono::milliseconds period{10'000};
  /// A child is started again at once; if it fails again within the period, after this, and then
  /// after twice as long each time.
  std::chrono::milliseconds first_delay{100};
  std::chrono::milliseconds longest_delay{5000};

  friend bool operator==(const SupervisionPolicy&, const SupervisionPolicy&) = default;
};

} // namespace castor
