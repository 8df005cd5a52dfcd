#pragma once

#include "castor/actors/cast/preprocessor.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <set>
#include <string>

namespace castor::cast {

/// Reports a name that nothing has. The remedy is the nearest of the names that there are, or else
/// `otherwise`; looking for the nearest costs nothing once there are too many errors to be told.
void report_unknown(const std::string& name, const std::set<std::string, std::less<>>& known,
                    std::string message, std::string otherwise, const StructureLine& line,
                    DiagnosticLog& log);

} // namespace castor::cast
