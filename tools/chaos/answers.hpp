#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/entries/lease.hpp"

#include <optional>

/// What working memories answer, in the words of histories.
namespace castor::linearizability {

/// Nothing if no operation ends so.
std::optional<Status> status_of(FailureKind failure, OperationKind operation);

castor::LockLevel level_of(LockLevel x);

} // namespace castor::linearizability
