#pragma once

#include "castor/actors/cast/parse_options.hpp"
#include "castor/actors/cast/reader.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <functional>
#include <set>
#include <string>

namespace castor::cast {

/// The variables that a source defines or uses, in blocks that conditions disable, too; without
/// those that the parser sets.
std::set<std::string, std::less<>> variables_in(const Source& source);

/// Reports variables that the caller defines and that the source does not have, and those that only
/// the parser may set.
void check_given_variables(const Source& source, const ParseOptions& options, DiagnosticLog& log);

} // namespace castor::cast
