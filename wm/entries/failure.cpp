#include "castor/wm/entries/failure.hpp"

namespace castor {

void throw_failure(const Failure& failure) {
  switch (failure.kind) {
    case FailureKind::does_not_exist:
      throw DoesNotExistOnWM{failure};
    case FailureKind::already_exists:
      throw AlreadyExistsOnWM{failure};
    case FailureKind::inconsistent:
      throw ConsistencyException{failure};
    case FailureKind::not_permitted:
      throw PermissionException{failure};
    case FailureKind::unknown_subarchitecture:
      throw UnknownSubarchitectureException{failure};
    case FailureKind::wrong_type:
      throw TypeMismatchException{failure};
    case FailureKind::no_answer:
      throw DeadlineException{failure};
    case FailureKind::working_memory_lost:
      throw WorkingMemoryLostException{failure};
    case FailureKind::leased:
      throw PermissionException{failure};
    case FailureKind::lease_lost:
      throw LeaseLostException{failure};
    case FailureKind::deadlock:
      throw DeadlockException{failure};
    case FailureKind::bad_address:
      throw BadAddressException{failure};
    case FailureKind::too_large:
      throw EntryTooLargeException{failure};
    case FailureKind::bad_predicate:
      throw PredicateException{failure};
    case FailureKind::not_atomic:
      throw NotAtomicException{failure};
    case FailureKind::call_failed:
      throw CallException{failure};
  }
  throw WorkingMemoryException{failure};
}

} // namespace castor
