#include "castor/tools/linearizability/history.hpp"

namespace castor::linearizability {

namespace {

std::string arguments(const OperationRecord& x) {
  auto token = x.token == 0 ? "" : " with token " + std::to_string(x.token);
  switch (x.kind) {
    case OperationKind::add:
      return " content " + std::to_string(x.content);
    case OperationKind::overwrite:
      return " content " + std::to_string(x.content) +
             (x.last_seen ? " over version " + std::to_string(*x.last_seen) : " unseen") + token;
    case OperationKind::lock:
    case OperationKind::try_lock:
      return " " + to_string(x.level);
    case OperationKind::lapse:
      return (x.token == 0 ? " of any lease" : " of token " + std::to_string(x.token)) +
             (x.mandatory ? "" : ", perhaps");
    default:
      return token;
  }
}

std::string moment(Tick x) {
  return x == never ? "..." : std::to_string(x);
}

} // namespace

std::string to_string(Status x) {
  switch (x) {
    case Status::ok:
      return "ok";
    case Status::does_not_exist:
      return "does not exist";
    case Status::already_exists:
      return "already exists";
    case Status::inconsistent:
      return "inconsistent";
    case Status::locked:
      return "locked";
    case Status::stale:
      return "stale";
    case Status::busy:
      return "busy";
    case Status::never_existed:
      return "never existed";
    case Status::timed_out:
      return "timed out";
  }
  return "?";
}

std::string to_string(OperationKind x) {
  switch (x) {
    case OperationKind::add:
      return "add";
    case OperationKind::overwrite:
      return "overwrite";
    case OperationKind::remove:
      return "remove";
    case OperationKind::read:
      return "read";
    case OperationKind::exists:
      return "exists";
    case OperationKind::version:
      return "version";
    case OperationKind::lock:
      return "lock";
    case OperationKind::try_lock:
      return "try_lock";
    case OperationKind::unlock:
      return "unlock";
    case OperationKind::lapse:
      return "lapse";
    case OperationKind::loss:
      return "loss";
  }
  return "?";
}

std::string to_string(LockLevel x) {
  switch (x) {
    case LockLevel::o:
      return "O";
    case LockLevel::od:
      return "OD";
    case LockLevel::odr:
      return "ODR";
  }
  return "?";
}

std::string to_string(OperationKind kind, const Result& x) {
  if (x.status != Status::ok)
    return to_string(x.status);
  switch (kind) {
    case OperationKind::add:
    case OperationKind::overwrite:
    case OperationKind::remove:
    case OperationKind::version:
      return "version " + std::to_string(x.version);
    case OperationKind::read:
      return "version " + std::to_string(x.version) + ", content " + std::to_string(x.content);
    case OperationKind::lock:
    case OperationKind::try_lock:
      return "token " + std::to_string(x.token);
    default:
      return "ok";
  }
}

std::string to_string(const OperationRecord& x) {
  auto who = x.kind == OperationKind::loss ? "" : "client " + std::to_string(x.client) + " ";
  std::string result = who + to_string(x.kind) + arguments(x);
  if (x.kind != OperationKind::lapse && x.kind != OperationKind::loss)
    result += x.pending() ? " -> pending" : " -> " + to_string(x.kind, x.result);
  result += " [" + moment(x.invoked) + ", " + moment(x.returned);
  if (x.queued_by != never)
    result += "; queued by " + moment(x.queued_by);
  return result + "]";
}

} // namespace castor::linearizability
