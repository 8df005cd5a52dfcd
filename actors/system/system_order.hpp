#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/base/diagnostic.hpp"

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace castor {

/// Why the system could not be changed; empty if it was.
struct OrderOutcome {
  std::string problem;
  /// Findings about the components that were to be added.
  std::vector<Diagnostic> findings;
};

/// Request to change a system.
struct SystemOrder {
  /// Architecture to add, or name of a component or subarchitecture to remove.
  std::variant<ArchitectureDescription, std::string> what;
  /// To be called with the outcome.
  std::function<void(const OrderOutcome&)> done;
};

} // namespace castor
