#pragma once

#include "castor/actors/faults/linearizability/history.hpp"
#include "castor/wm/failure.hpp"
#include "castor/wm/lease.hpp"

#include <optional>

/// What working memories answer, in the words of histories.
namespace castor::linearizability {

/// Nothing if no operation ends so.
std::optional<Status> status_of(FailureKind failure, OperationKind operation);

castor::LockLevel level_of(LockLevel x);

} // namespace castor::linearizability
