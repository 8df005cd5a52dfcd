#pragma once

#include "castor/tools/linearizability/history.hpp"

/// Operations as tests write them down.
namespace castor::linearizability {

struct Span {
  Tick invoked = 0;
  Tick returned = never;
};

inline constexpr auto o = LockLevel::o;
inline constexpr auto od = LockLevel::od;
inline constexpr auto odr = LockLevel::odr;

inline constexpr Result done{};

inline Result failed(Status status) {
  return {status};
}
/// Of an add, overwrite, deletion or look at the version.
inline Result at_version(Version version) {
  return {Status::ok, version};
}
inline Result saw(Version version, Content content) {
  return {Status::ok, version, content};
}
inline Result obtained(Token token) {
  return {.token = token};
}

OperationRecord add(Client client, Content content, Span span, Result result = {});
OperationRecord overwrite(Client client, Content content, std::optional<Version> last_seen,
                          Span span, Result result = {}, Token token = 0);
OperationRecord remove(Client client, Span span, Result result = {}, Token token = 0);
OperationRecord read(Client client, Span span, Result result = {});
OperationRecord exists(Client client, Span span, Result result = {});
OperationRecord version(Client client, Span span, Result result = {});
OperationRecord lock(Client client, LockLevel level, Span span, Result result = {});
OperationRecord try_lock(Client client, LockLevel level, Span span, Result result = {});
OperationRecord unlock(Client client, Token token, Span span, Result result = {});
OperationRecord lapse(Client holder, Token token, Span span);
OperationRecord mandatory_lapse(Client holder, Token token, Span span);

/// Of the entry and all that was known of it; an addition gets that version.
OperationRecord loss(Version version, Token token, Span span);
OperationRecord loss(Result begins_with, Token token, Span span);

OperationRecord queued_by(Tick moment, OperationRecord operation);
/// The history and one more operation.
History with(History history, const OperationRecord& operation);

OperationRecord on_entry(std::uint32_t entry, OperationRecord operation);

} // namespace castor::linearizability
