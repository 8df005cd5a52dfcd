#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// An INCLUDE line on the way from the main file to a line.
struct IncludeSite {
  std::string file;
  std::size_t line = 0;

  friend bool operator==(const IncludeSite& a, const IncludeSite& b) = default;
};

struct SourceUnit;

/// A line of a `.cast` file, and how the reader got there. Cheap to copy: all lines of one file
/// share its name and its include chain.
class SourceLocation {
public:
  SourceLocation() = default;

  /// @param unit the file, as it was reached
  /// @param line counted from 1; 0 means the file as a whole
  /// @param order position among the lines of all files, from 1; 0 where that is not known
  SourceLocation(std::shared_ptr<const SourceUnit> unit, std::size_t line, std::uint64_t order = 0);

  /// A line of a file that no other file includes.
  SourceLocation(std::string file, std::size_t line);

  /// The path as given or as written in the INCLUDE line; empty for an unknown place.
  const std::string& file() const noexcept;

  std::size_t line() const noexcept { return line_; }

  /// Where the line comes among those of all files, included ones in the place of their INCLUDE
  /// lines: the order of messages.
  std::uint64_t order() const noexcept { return order_; }

  /// The INCLUDE lines that led to this file, innermost first; empty for the main file.
  std::vector<IncludeSite> include_chain() const;

  friend bool operator==(const SourceLocation& a, const SourceLocation& b);

private:
  std::shared_ptr<const SourceUnit> unit_;
  std::uint32_t line_ = 0;
  std::uint64_t order_ = 0;
};

/// One file, reached in one way: a file that is included twice makes two units.
struct SourceUnit {
  std::string file;
  SourceLocation included_from;
};

/// "file:line", or the file alone when the place is the whole file.
std::string to_string(const SourceLocation& where);

} // namespace castor
