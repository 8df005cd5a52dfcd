#pragma once

#include "castor/actors/cast/preprocessor.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <set>
#include <string>

namespace castor::cast {

/// Reports an unknown name. The remedy is the nearest known name, or else `otherwise`; the nearest
/// one is not searched for once the limit of reported errors is reached.
void report_unknown(const std::string& name, const std::set<std::string, std::less<>>& known,
                    std::string message, std::string otherwise, const StructureLine& line,
                    DiagnosticLog& log);

} // namespace castor::cast
