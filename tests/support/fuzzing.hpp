#pragma once

#include "castor/actors/cast/parser.hpp"

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>

namespace castor::test {

/// Ends the process, as a fuzzer expects it, unless the condition holds. Other than assert, in
/// every build.
inline void require(bool condition) {
  if (!condition)
    std::abort();
}

/// Nothing outside of the input is read, and the limits are small enough to be reached by small
/// inputs.
inline cast::ParseOptions hermetic_options() {
  cast::ParseOptions options;
  options.load = [](const std::string&, std::size_t) -> FileContent {
    return {std::nullopt, "no such file"};
  };
  options.limits.line_bytes = 1000;
  options.limits.total_bytes = 20'000;
  options.limits.lines = 1000;
  options.limits.diagnostics = 20;
  return options;
}

} // namespace castor::test
