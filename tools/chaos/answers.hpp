#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/entries/lease.hpp"

#include <optional>

/// Converts results of working memories to those of histories.
namespace castor::linearizability {

/// Status of an operation that ended with this failure; nothing if this failure is not a result of
/// such operations.
std::optional<Status> status_of(FailureKind failure, OperationKind operation);

castor::LockLevel level_of(LockLevel x);

} // namespace castor::linearizability
