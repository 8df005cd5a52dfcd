#pragma once

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::simulation {

/// Seeds from the first to the last, both included; at least one.
struct Seeds {
  std::uint64_t from = 1;
  std::uint64_t to = 1;

  std::uint64_t size() const { return to - from + 1; }
  friend bool operator==(const Seeds&, const Seeds&) = default;
};

/// Parses FROM..TO, or one number. Throws std::invalid_argument with the error.
inline Seeds parse_seeds(std::string_view text) {
  auto number = [&](std::string_view digits) {
    std::uint64_t result = 0;
    auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), result);
    if (error != std::errc{} || end != digits.data() + digits.size())
      throw std::invalid_argument("\"" + std::string{text} +
                                  "\" are no seeds: write FROM..TO with whole numbers, as in "
                                  "1..1000");
    return result;
  };
  auto dots = text.find("..");
  Seeds result;
  result.from = number(text.substr(0, dots));
  result.to = dots == std::string_view::npos ? result.from : number(text.substr(dots + 2));
  if (result.to < result.from)
    throw std::invalid_argument("\"" + std::string{text} +
                                "\" are no seeds: the first is above the last");
  if (result.from == 0 && result.to == UINT64_MAX)
    throw std::invalid_argument("\"" + std::string{text} + "\" are too many seeds");
  return result;
}

inline std::string to_string(const Seeds& x) {
  return std::to_string(x.from) + ".." + std::to_string(x.to);
}

} // namespace castor::simulation
