#pragma once

#include "castor/tests/linearizability/history.hpp"
#include "castor/wm/entry.hpp"
#include "castor/wm/failure.hpp"
#include "castor/wm/lease.hpp"

#include <optional>

/// What clients see of working memories, in the words of histories.
namespace castor::linearizability {

/// What the entries hold.
struct Stamp {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Stamp, number)

/// Nothing if no operation ends so.
std::optional<Status> status_of(FailureKind failure, OperationKind operation);

castor::LockLevel level_of(LockLevel x);

Content content_of(const Entry& entry);

} // namespace castor::linearizability
