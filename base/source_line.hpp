#pragma once

#include "castor/base/source_location.hpp"

#include <cstdint>
#include <memory>
#include <string_view>

namespace castor {

/// One line of a source file. Text and unit are owned by its `Source`.
struct SourceLine {
  enum class Kind : std::uint8_t {
    text,
    /// Marker, not a line of a file: the following lines are from the file of `unit`.
    enter_file
  };

  /// Trimmed.
  std::string_view text;
  std::shared_ptr<const SourceUnit> unit;
  /// Counted from 1 within the file.
  std::uint32_t number = 0;
  /// Position among all lines of all files, the order in which diagnostics are listed.
  std::uint32_t order = 0;
  Kind kind = Kind::text;

  SourceLocation where() const { return {unit, number, std::uint64_t{order} + 1}; }
};

} // namespace castor
