#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// An INCLUDE line in the chain from the main file to a line.
struct IncludeSite {
  std::string file;
  std::size_t line = 0;

  friend bool operator==(const IncludeSite& a, const IncludeSite& b) = default;
};

struct SourceUnit;

/// A line of a `.cast` file, with its include chain. Cheap to copy: all lines of one file share
/// name and include chain.
class SourceLocation {
public:
  SourceLocation() = default;

  /// @param unit the file, with its include chain
  /// @param line counted from 1; 0 means the file as a whole
  /// @param order position among the lines of all files, from 1; 0 where that is not known
  SourceLocation(std::shared_ptr<const SourceUnit> unit, std::size_t line, std::uint64_t order = 0);

  /// A line of a file that no other file includes.
  SourceLocation(std::string file, std::size_t line);

  /// The path as given or as written in the INCLUDE line; empty for an unknown place.
  const std::string& file() const noexcept;

  std::size_t line() const noexcept { return line_; }

  /// Position among the lines of all files, with included lines in place of their INCLUDE lines.
  /// Messages are sorted by it.
  std::uint64_t order() const noexcept { return order_; }

  /// The INCLUDE lines that led to this file, innermost first; empty for the main file.
  std::vector<IncludeSite> include_chain() const;

  friend bool operator==(const SourceLocation& a, const SourceLocation& b);

private:
  std::shared_ptr<const SourceUnit> unit_;
  std::uint32_t line_ = 0;
  std::uint64_t order_ = 0;
};

/// One inclusion of a file: a file that is included twice has two units.
struct SourceUnit {
  std::string file;
  SourceLocation included_from;
};

/// "file:line", or the file alone for the whole file.
std::string to_string(const SourceLocation& where);

} // namespace castor
