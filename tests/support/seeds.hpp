#pragma once

#include <cstdint>
#include <string>

namespace castor::test {

struct Seeds {
  std::uint64_t from = 1;
  std::uint64_t to = 1;
};

/// Reads FROM..TO, or one number. Throws std::invalid_argument and std::out_of_range.
inline Seeds parse_seeds(const std::string& text) {
  auto dots = text.find("..");
  Seeds result;
  result.from = std::stoull(text.substr(0, dots));
  result.to = dots == std::string::npos ? result.from : std::stoull(text.substr(dots + 2));
  return result;
}

} // namespace castor::test
