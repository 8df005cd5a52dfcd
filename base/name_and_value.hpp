#pragma once

#include <optional>
#include <string>
#include <utility>

namespace castor {

/// The parts of a text such as "sphere=ball", at its first "="; nothing if there is none, or one of
/// them is empty.
inline std::optional<std::pair<std::string, std::string>> name_and_value(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return std::nullopt;
  return std::pair{text.substr(0, equals), text.substr(equals + 1)};
}

} // namespace castor
