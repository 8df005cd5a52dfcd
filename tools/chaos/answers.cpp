#include "castor/tools/chaos/answers.hpp"

namespace castor::linearizability {

std::optional<Status> status_of(FailureKind failure, OperationKind operation) {
  switch (failure) {
    case FailureKind::does_not_exist:
      return operation == OperationKind::version ? Status::never_existed : Status::does_not_exist;
    case FailureKind::already_exists:
      return Status::already_exists;
    case FailureKind::inconsistent:
      return Status::inconsistent;
    case FailureKind::leased:
      return operation == OperationKind::try_lock ? Status::busy : Status::locked;
    case FailureKind::lease_lost:
      return Status::stale;
    case FailureKind::no_answer:
      return Status::timed_out;
    default:
      return std::nullopt;
  }
}

castor::LockLevel level_of(LockLevel x) {
  switch (x) {
    case LockLevel::o:
      return castor::LockLevel::o;
    case LockLevel::od:
      return castor::LockLevel::od;
    default:
      return castor::LockLevel::odr;
  }
}

} // namespace castor::linearizability
