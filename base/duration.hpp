#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace castor {

/// A number with its unit: 250ms, 10s, 2min, 1h. Nothing for any other text.
std::optional<std::chrono::milliseconds> parse_duration(std::string_view text) noexcept;

/// As `parse_duration` reads it: "250ms", "10s".
std::string to_string(std::chrono::milliseconds x);

/// The number of seconds, with their fractions.
template <class Rep, class Period>
constexpr double in_seconds(std::chrono::duration<Rep, Period> x) noexcept {
  return std::chrono::duration<double>(x).count();
}

} // namespace castor
