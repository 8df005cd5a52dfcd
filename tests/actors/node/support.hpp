#pragma once

#include "castor/actors/cast/parser.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace castor::test {

inline ArchitectureDescription architecture(const std::string& text) {
  auto result = cast::parse_string(text, "test.cast");
  if (!result.architecture)
    throw std::runtime_error(render(result.diagnostics));
  return *std::move(result.architecture);
}

/// To be followed by its components.
inline std::string subarchitecture(const std::string& name, const std::string& host) {
  return "SUBARCHITECTURE " + name + ' ' + host + "\nCPP WM W\nCPP TM T\n";
}

} // namespace castor::test
