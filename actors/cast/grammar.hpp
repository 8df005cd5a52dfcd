#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/parse_options.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <functional>
#include <set>
#include <string>

namespace castor::cast {

struct Structure {
  /// `file` and `config_dir` are left empty. With errors in the log, it is good for further checks
  /// only: it may have subarchitectures twice, and some without a name.
  ArchitectureDescription architecture;
  /// The words of lines that were not understood.
  std::set<std::string, std::less<>> doubtful;
};

/// Third pass: reads sections and component lines.
Structure parse_structure(Preprocessed& input, const ParseOptions& options, DiagnosticLog& log);

} // namespace castor::cast
