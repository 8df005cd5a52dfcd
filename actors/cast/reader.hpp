#pragma once

#include "castor/actors/cast/parse_options.hpp"
#include "castor/base/diagnostic_log.hpp"
#include "castor/base/source_line.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

/// All lines of a file and of what it includes, in the order in which they take effect.
struct Source {
  /// Each entry into a file, and each return to one, is marked by a line of kind `enter_file`.
  std::vector<SourceLine> lines;
  /// Storage of the line texts.
  std::vector<std::shared_ptr<const std::string>> texts;
  /// A limit was hit: lines are missing, so that their absence means nothing.
  bool truncated = false;
};

/// First pass: reads a file, splits it into trimmed lines, and puts included files in the place of
/// INCLUDE lines, whatever conditional block these are in. Files that cannot be read, include
/// cycles and exceeded limits are reported; reading goes on behind the offending line.
Source read_source(const std::string& file, const ParseOptions& options, DiagnosticLog& log);

/// The same for a text that is taken for the content of `file`; included files are still loaded.
Source read_source(std::string_view text, const std::string& file, const ParseOptions& options,
                   DiagnosticLog& log);

} // namespace castor::cast
