#include "castor/tests/tools/linearizability/records.hpp"

namespace castor::linearizability {

namespace {

OperationRecord record(Client client, OperationKind kind, Span span, Result result) {
  OperationRecord x;
  x.client = client;
  x.kind = kind;
  x.result = result;
  x.invoked = span.invoked;
  x.returned = span.returned;
  return x;
}

} // namespace

OperationRecord add(Client client, Content content, Span span, Result result) {
  auto x = record(client, OperationKind::add, span, result);
  x.content = content;
  return x;
}

OperationRecord overwrite(Client client, Content content, std::optional<Version> last_seen,
                          Span span, Result result, Token token) {
  auto x = record(client, OperationKind::overwrite, span, result);
  x.content = content;
  x.last_seen = last_seen;
  x.token = token;
  return x;
}

OperationRecord remove(Client client, Span span, Result result, Token token) {
  auto x = record(client, OperationKind::remove, span, result);
  x.token = token;
  return x;
}

OperationRecord read(Client client, Span span, Result result) {
  return record(client, OperationKind::read, span, result);
}

OperationRecord exists(Client client, Span span, Result result) {
  return record(client, OperationKind::exists, span, result);
}

OperationRecord version(Client client, Span span, Result result) {
  return record(client, OperationKind::version, span, result);
}

OperationRecord lock(Client client, LockLevel level, Span span, Result result) {
  auto x = record(client, OperationKind::lock, span, result);
  x.level = level;
  return x;
}

OperationRecord try_lock(Client client, LockLevel level, Span span, Result result) {
  auto x = record(client, OperationKind::try_lock, span, result);
  x.level = level;
  return x;
}

OperationRecord unlock(Client client, Token token, Span span, Result result) {
  auto x = record(client, OperationKind::unlock, span, result);
  x.token = token;
  return x;
}

OperationRecord lapse(Client holder, Token token, Span span) {
  auto x = record(holder, OperationKind::lapse, span, {});
  x.token = token;
  return x;
}

OperationRecord mandatory_lapse(Client holder, Token token, Span span) {
  auto x = lapse(holder, token, span);
  x.mandatory = true;
  return x;
}

OperationRecord loss(Version version, Token token, Span span) {
  return loss({.status = Status::never_existed, .version = version}, token, span);
}

OperationRecord loss(Result begins_with, Token token, Span span) {
  begins_with.token = token;
  return record(0, OperationKind::loss, span, begins_with);
}

OperationRecord queued_by(Tick moment, OperationRecord operation) {
  operation.queued_by = moment;
  return operation;
}

History with(History history, const OperationRecord& operation) {
  history.push_back(operation);
  return history;
}

OperationRecord on_entry(std::uint32_t entry, OperationRecord operation) {
  operation.entry = entry;
  return operation;
}

} // namespace castor::linearizability
