#include "castor/tools/cli/pace_option.hpp"

#include <charconv>
#include <cmath>

namespace castor::cli {

namespace {

/// Nothing if the text is no factor.
std::optional<double> factor(const std::string& text) {
  double result = 0;
  auto* end = text.data() + text.size();
  auto read = std::from_chars(text.data(), end, result);
  if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(result) ||
      result < slowest_pace || result > fastest_pace)
    return std::nullopt;
  return result;
}

} // namespace

std::optional<Pace> pace(const std::string& text) {
  if (text.empty())
    return std::nullopt;
  Pace result;
  result.paused = text == "paused";
  if (!result.paused && text != "max")
    result.factor = factor(text);
  return result;
}

std::string check_pace(const std::string& text) {
  if (text == "max" || text == "paused" || factor(text))
    return {};
  return "'" + text +
         "' is no speed: write max, paused, or a factor of real time from 0.001 to "
         "1000000, such as 10";
}

} // namespace castor::cli
