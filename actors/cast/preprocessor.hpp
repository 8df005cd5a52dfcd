#pragma once

#include "castor/actors/cast/hosts.hpp"
#include "castor/actors/cast/parse_options.hpp"
#include "castor/actors/cast/reader.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

/// A line that describes the architecture.
struct StructureLine {
  /// After replacement of variables, trimmed, not blank.
  std::string_view text;
  const SourceLine* line = nullptr;
};

/// A source after evaluation of its variables and conditions. Refers to the source.
struct Preprocessed {
  std::vector<StructureLine> lines;
  /// Storage of those line texts that do not point into the source.
  std::deque<std::string> texts;
  HostTable hosts;
  /// Comment lines that begin with `#EXPAND`, expanded: in disabled blocks too, and without
  /// warnings, because they exist to see what the variables hold.
  std::vector<std::string> expansions;
  /// A limit was hit: lines are missing.
  bool truncated = false;
};

/// Second pass: executes variable commands, HOSTNAME lines and conditionals, and replaces variables
/// in all other lines.
/// @param main_dir value of MAIN_DIR
/// @param working_directory what CURRENT_DIR and CURRENT_FILE are relative to
Preprocessed preprocess(const Source& source, const ParseOptions& options,
                        const std::string& main_dir, const std::string& working_directory,
                        DiagnosticLog& log);

} // namespace castor::cast
