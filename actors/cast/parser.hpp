#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/parse_options.hpp"
#include "castor/base/diagnostic.hpp"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

/// What could be understood of a file with errors.
struct Understood {
  ArchitectureDescription architecture;
  /// Words of the lines that were not understood; names among them may exist.
  std::set<std::string, std::less<>> doubtful;
  /// Lines are missing, so the absence of a name is no error.
  bool is_incomplete = false;
};

struct ParseResult {
  /// Present exactly if no diagnostic is an error.
  std::optional<ArchitectureDescription> architecture;
  /// Without an architecture: the part that was understood, for further checks only.
  Understood understood;
  /// All findings, in the order of the lines they are about.
  std::vector<Diagnostic> diagnostics;
  /// The comment lines that begin with `#EXPAND`, with their variables replaced; also there if the
  /// file has errors.
  std::vector<std::string> expansions;

  bool ok() const noexcept { return architecture.has_value(); }
};

/// Reads a `.cast` file and all it includes. Never throws for what the files contain: whatever is
/// wrong with them, or with reading them, is among the diagnostics. Parses share no state.
/// @param file absolute, or relative to the process's working directory
ParseResult parse_file(const std::string& file, const ParseOptions& options = {});

/// Takes `text` for the content of `file_name`, which need not exist. Files that it includes are
/// looked for in the directory of `file_name`.
ParseResult parse_string(std::string_view text, const std::string& file_name,
                         const ParseOptions& options = {});

} // namespace castor::cast
