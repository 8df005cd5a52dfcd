#pragma once

#include "castor/actors/link/wire.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

/// Wire form of the messages to components and working memories. The order of the members is the
/// format: all processes of a system must have the same version, which is checked in the greetings.
namespace castor {

// -- the last enumerators

CASTOR_WIRE_ENUM(Operation, remove)
CASTOR_WIRE_ENUM(FailureKind, call_failed)
CASTOR_WIRE_ENUM(LockLevel, odr)
CASTOR_WIRE_ENUM(WaitEdge::Kind, owner)
CASTOR_WIRE_ENUM(EventStream, runtime)
CASTOR_WIRE_ENUM(JournalMode, batched)
CASTOR_WIRE_ENUM(Phase, run)
CASTOR_WIRE_ENUM(TaskDecision, waiting)
CASTOR_WIRE_ENUM(TaskOutcome, incomplete)
CASTOR_WIRE_ENUM(CommandResult, failed)

// -- shared types

CASTOR_WIRE(Address, subarchitecture, id)
CASTOR_WIRE(Client, component, subarchitecture, incarnation)
CASTOR_WIRE(Failure, kind, message, address)

template <class A>
void wire(A& a, WirePart<A, Predicate>& x) {
  if constexpr (A::writes) {
    a(x.text());
  } else {
    try {
      x = Predicate::parse(a.template take<std::string>());
    } catch (const PredicateError& e) {
      throw DecodeError(e.what());
    }
  }
}

// -- entries

CASTOR_WIRE(EntryLife, time_to_live, ephemeral, only_once, writable_by_all)
CASTOR_WIRE(LastWill, value, life)
CASTOR_WIRE(Entry, address, version, value, writer, life)

CASTOR_WIRE(WriteRequest, operation, address, value, last_seen, client, token, life, expected,
            last_will)
inline void check_read(const WriteRequest& x) {
  if (x.operation != Operation::remove && !x.value.has_value())
    throw DecodeError("a write without a value");
}

CASTOR_WIRE(BatchRequest, subarchitecture, writes)

CASTOR_WIRE(Patience, client, number, at_most)
CASTOR_WIRE_NULLABLE(Patience, client)

CASTOR_WIRE(ReadRequest, address, patience)
CASTOR_WIRE(TypeQuery, subarchitecture, type, count, with_derived, predicate)
CASTOR_WIRE(QueryRequest, query, patience)
CASTOR_WIRE(ExistsQuery, address, client)
CASTOR_WIRE_NULLABLE(ExistsQuery, client)
CASTOR_WIRE(VersionQuery, address, client)
CASTOR_WIRE_NULLABLE(VersionQuery, client)

// -- leases

CASTOR_WIRE_EXCEPT(LockRequest, (claims), address, level, patience)
inline void check_read(const LockRequest& x) {
  if (!x.patience.client)
    throw DecodeError("a lock request without a client");
}

CASTOR_WIRE(Lease, token, level, expires)
CASTOR_WIRE(UnlockRequest, address, client, token)
CASTOR_WIRE(CancelWait, address, client, number)
CASTOR_WIRE(HeldToken, id, token)
CASTOR_WIRE(RenewRequest, client, leases)
CASTOR_WIRE(RenewReply, lost)
CASTOR_WIRE(LockQuery, address)

CASTOR_WIRE(LockStatus, level, holder, token, waiting)
CASTOR_WIRE_NULLABLE(LockStatus, holder)

CASTOR_WIRE(WaitEdge, kind, waiter, number, since, address, what, obstacle)
CASTOR_WIRE(DeadlockProbe, path, round)

// -- events

CASTOR_WIRE(ChangeFilter, operation, type, id, source, subarchitecture, changing, predicate)
CASTOR_WIRE(Subscribe, id, filter, stream, queue_limit, component)
CASTOR_WIRE(Unsubscribe, id)
CASTOR_WIRE(ChangeEvent, operation, address, source, type, version, sequence, time, changed,
            coalesced)
CASTOR_WIRE(ChangeNotice, event, filters)
CASTOR_WIRE(ChangeNotices, notices)
CASTOR_WIRE(EventsTaken, stream, count)
CASTOR_WIRE(Interest, subarchitecture, id, filter, wanted)
CASTOR_WIRE(RoutedEvent, event, receivers)
CASTOR_WIRE(RoutedEvents, events)

// -- a working memory as a whole

CASTOR_WIRE(Acknowledged)
CASTOR_WIRE(StatusQuery)
CASTOR_WIRE(JournalStatus, mode, bytes, unsynced, held, syncs, incarnation, failure)
CASTOR_WIRE(WorkingMemoryStatus, subarchitecture, entries, entries_by_type, filters, events,
            last_event, matched, delivered, coalesced, suppressed, backlog, forwarded, routed,
            refused, leases, waiting, journal)
CASTOR_WIRE(UsageQuery)
CASTOR_WIRE(Usage, component, subarchitecture, type, adds, overwrites, deletes, reads, events)
CASTOR_WIRE(UsageReport, usages)

// -- components

template <class A>
void wire(A& a, WirePart<A, caf::actor>& x) {
  if constexpr (A::writes)
    a(caf::actor_cast<caf::strong_actor_ptr>(x));
  else
    x = caf::actor_cast<caf::actor>(a.template take<caf::strong_actor_ptr>());
}

CASTOR_WIRE(EnterPhase, phase, phase_controller)
CASTOR_WIRE(PhaseDone, component, phase, failure)
CASTOR_WIRE(TaskOptions, priority, cost, after)
CASTOR_WIRE(TaskProposal, id, name, component, options)
CASTOR_WIRE(ProposeTask, proposal)
CASTOR_WIRE(RetractTask, id)
CASTOR_WIRE(CompleteTask, id, outcome)
CASTOR_WIRE(TaskDecided, id, decision, reason)
CASTOR_WIRE(PullRequest, type, argument)
CASTOR_WIRE(PushRequest, type, limit, subscriber)
CASTOR_WIRE(Pushed, provider, value)
CASTOR_WIRE(PushesTaken, type, count)
CASTOR_WIRE(CommandTermsQuery, type)
CASTOR_WIRE(CommandTerms, valid_for, lease, commander)
CASTOR_WIRE(CommandTermsReply, terms, clock)
CASTOR_WIRE(CommandMessage, value, commander, token, sent, valid_for, number)
CASTOR_WIRE(CommandDone, effector, type, number, result, reason, clock)

/// Times of commands are added to others.
inline void check_command_time(Timestamp x) {
  if (x < Timestamp{0} || x > longest_command_time)
    throw DecodeError("an impossible time of a command");
}
inline void check_read(const CommandTerms& x) {
  check_command_time(x.valid_for);
}
inline void check_read(const CommandTermsReply& x) {
  check_command_time(x.clock);
}
inline void check_read(const CommandMessage& x) {
  if (!x.value.has_value())
    throw DecodeError("a command without a value");
  check_command_time(x.sent);
  check_command_time(x.valid_for);
}
inline void check_read(const CommandDone& x) {
  check_command_time(x.clock);
}

} // namespace castor
