#include "castor/tools/chaos/quantities.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <utility>

namespace castor::faults {

namespace {

constexpr std::size_t most_digits = 9;
constexpr std::size_t most_decimals = 6;

/// A number as it is written: `whole` + `fraction` / `denominator`.
struct Decimal {
  std::int64_t whole = 0;
  std::int64_t fraction = 0;
  std::int64_t denominator = 1;
};

std::int64_t value_of_digits(std::string_view digits) {
  std::int64_t result = 0;
  for (char c : digits)
    result = result * 10 + (c - '0');
  return result;
}

bool are_digits(std::string_view text, std::size_t most) {
  return !text.empty() && text.size() <= most && std::ranges::all_of(text, is_digit);
}

std::optional<Decimal> parse_decimal(std::string_view text) {
  auto point = std::min(text.find('.'), text.size());
  auto whole = text.substr(0, point);
  if (!are_digits(whole, most_digits))
    return std::nullopt;
  Decimal result{value_of_digits(whole)};
  if (point == text.size())
    return result;
  auto fraction = text.substr(point + 1);
  if (!are_digits(fraction, most_decimals))
    return std::nullopt;
  result.fraction = value_of_digits(fraction);
  for (std::size_t i = 0; i < fraction.size(); ++i)
    result.denominator *= 10;
  return result;
}

/// So many times the number, if that is whole.
std::optional<std::int64_t> times(const Decimal& x, std::int64_t factor) {
  auto fraction = x.fraction * factor;
  if (fraction % x.denominator != 0)
    return std::nullopt;
  return x.whole * factor + fraction / x.denominator;
}

std::optional<std::uint32_t> parse_thousandths(std::string_view text, std::string_view unit,
                                               std::uint32_t most) {
  if (!text.ends_with(unit))
    return std::nullopt;
  auto number = parse_decimal(text.substr(0, text.size() - unit.size()));
  auto result = number ? times(*number, 1000) : std::nullopt;
  if (!result || *result <= 0 || *result > std::int64_t{most})
    return std::nullopt;
  return static_cast<std::uint32_t>(*result);
}

std::string thousandths_to_text(std::uint32_t x, std::string_view unit) {
  auto result = std::to_string(x / 1000);
  if (x % 1000 != 0) {
    auto fraction = std::to_string(1000 + x % 1000).substr(1);
    result += "." + fraction.substr(0, fraction.find_last_not_of('0') + 1);
  }
  return result.append(unit);
}

} // namespace

std::optional<Timestamp> parse_time(std::string_view text) {
  static constexpr std::pair<std::string_view, std::int64_t> units[] = {
    {"us", 1}, {"ms", 1000}, {"s", 1'000'000}, {"min", 60'000'000}, {"h", 3'600'000'000}};
  auto digits = std::min(text.find_first_not_of("0123456789."), text.size());
  auto number = parse_decimal(text.substr(0, digits));
  if (!number)
    return std::nullopt;
  for (auto& [unit, factor] : units) {
    if (text.substr(digits) != unit)
      continue;
    auto count = times(*number, factor);
    if (count && *count <= longest_time.count())
      return Timestamp{*count};
  }
  return std::nullopt;
}

std::optional<Percent> parse_percent(std::string_view text) {
  auto x = parse_thousandths(text, "%", everything.thousandths);
  return x ? std::optional{Percent{*x}} : std::nullopt;
}

std::optional<Rate> parse_rate(std::string_view text) {
  auto x = parse_thousandths(text, "/s", highest_rate.per_thousand_seconds);
  return x ? std::optional{Rate{*x}} : std::nullopt;
}

std::string to_text(Timestamp x) {
  if (x.count() % 1'000'000 == 0)
    return std::to_string(x.count() / 1'000'000) + "s";
  if (x.count() % 1000 == 0)
    return std::to_string(x.count() / 1000) + "ms";
  return std::to_string(x.count()) + "us";
}

std::string to_text(Percent x) {
  return thousandths_to_text(x.thousandths, "%");
}

std::string to_text(Rate x) {
  return thousandths_to_text(x.per_thousand_seconds, "/s");
}

} // namespace castor::faults
