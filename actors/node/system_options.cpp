#include "castor/actors/node/system_options.hpp"

#include <utility>

namespace castor {

SystemError::SystemError(std::vector<Diagnostic> diagnostics)
  : runtime_error(render(diagnostics)), diagnostics_(std::move(diagnostics)) {}

} // namespace castor
