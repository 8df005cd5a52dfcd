#include "castor/wm/failure.hpp"

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
  }
  throw WorkingMemoryException{failure};
}

} // namespace castor
