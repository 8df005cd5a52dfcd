#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/diagnostic_log.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/actors/cast/parse_options.hpp"

namespace castor::cast {

/// Third pass: reads sections and component lines. The result is meaningful only if the log has no
/// errors afterwards; `file` and `config_dir` are left empty.
ArchitectureDescription parse_structure(Preprocessed& input, const ParseOptions& options,
                                        DiagnosticLog& log);

} // namespace castor::cast
