#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/base/diagnostic.hpp"

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace castor {

/// Why the system could not be changed; all is empty if it was.
struct OrderOutcome {
  std::string problem;
  /// Of what was to be added.
  std::vector<Diagnostic> findings;
};

/// Somebody wants the system to be changed.
struct SystemOrder {
  /// What to add, or the name of what to remove.
  std::variant<ArchitectureDescription, std::string> what;
  /// To be called with what stood in the way.
  std::function<void(const OrderOutcome&)> done;
};

} // namespace castor
