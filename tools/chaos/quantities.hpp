#pragma once

#include "castor/wm/values/timestamp.hpp"

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace castor::faults {

/// Quantities in fault plans: whole numbers of a small unit, so that plans are exact on every
/// machine and are printed as they were read.

/// A share of the messages over a link.
struct Percent {
  /// Thousandths of a percent; 100,000 is everything.
  std::uint32_t thousandths = 0;

  friend auto operator<=>(const Percent&, const Percent&) = default;
};

/// Average frequency.
struct Rate {
  /// Times in a thousand seconds.
  std::uint32_t per_thousand_seconds = 0;

  friend auto operator<=>(const Rate&, const Rate&) = default;
};

inline constexpr Percent everything{100'000};
/// A plan's random faults are drawn millisecond by millisecond.
inline constexpr Rate highest_rate{100'000};
inline constexpr Timestamp longest_time{std::chrono::hours{1000}};

/// These parse a number and its unit. They return nothing for any other text and for values beyond
/// the limits above.

/// "20us", "50ms", "1.5s", "3min", "1h": a whole number of microseconds.
std::optional<Timestamp> parse_time(std::string_view text);
/// "10%", "0.125%": above zero.
std::optional<Percent> parse_percent(std::string_view text);
/// "0.5/s": above zero.
std::optional<Rate> parse_rate(std::string_view text);

/// In the syntax of `parse_...`.
std::string to_text(Timestamp x);
std::string to_text(Percent x);
std::string to_text(Rate x);

} // namespace castor::faults
