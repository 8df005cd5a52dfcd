#include "castor/base/duration.hpp"

#include <charconv>
#include <cmath>
#include <utility>

namespace castor {

std::optional<std::chrono::milliseconds> parse_duration(std::string_view text) noexcept {
  static constexpr std::pair<std::string_view, double> units[] = {
    {"ms", 1}, {"min", 60'000}, {"s", 1000}, {"h", 3'600'000}};
  auto digits = text.find_first_not_of("0123456789.");
  if (digits == text.npos)
    return std::nullopt;
  double number = 0;
  auto end = text.data() + digits;
  if (auto [rest, error] = std::from_chars(text.data(), end, number);
      error != std::errc{} || rest != end)
    return std::nullopt;
  for (auto& [unit, factor] : units)
    if (auto ms = number * factor; text.substr(digits) == unit && ms < 1e15)
      return std::chrono::milliseconds{std::llround(ms)};
  return std::nullopt;
}

std::string to_string(std::chrono::milliseconds x) {
  if (x.count() != 0 && x.count() % 1000 == 0)
    return std::to_string(x.count() / 1000) + "s";
  return std::to_string(x.count()) + "ms";
}

} // namespace castor
