#pragma once

#include "castor/actors/link/wire.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

/// The wire form of what is said to components and working memories. The order of the parts is the
/// format: processes of one system must be of one version, which they tell each other first.
namespace castor {

// -- the last enumerators

constexpr Operation last_of(Operation) {
  return Operation::remove;
}
constexpr FailureKind last_of(FailureKind) {
  return FailureKind::call_failed;
}
constexpr LockLevel last_of(LockLevel) {
  return LockLevel::odr;
}
constexpr WaitEdge::Kind last_of(WaitEdge::Kind) {
  return WaitEdge::Kind::owner;
}
constexpr EventStream last_of(EventStream) {
  return EventStream::runtime;
}
constexpr JournalMode last_of(JournalMode) {
  return JournalMode::batched;
}
constexpr Phase last_of(Phase) {
  return Phase::run;
}
constexpr TaskDecision last_of(TaskDecision) {
  return TaskDecision::waiting;
}
constexpr TaskOutcome last_of(TaskOutcome) {
  return TaskOutcome::incomplete;
}

// -- what all of them speak of

template <class A>
void wire(A& a, WirePart<A, Address>& x) {
  a(x.subarchitecture, x.id);
}

template <class A>
void wire(A& a, WirePart<A, Client>& x) {
  a(x.component, x.subarchitecture, x.incarnation);
}

template <class A>
void wire(A& a, WirePart<A, Failure>& x) {
  a(x.kind, x.message, x.address);
}

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

template <class A>
void wire(A& a, WirePart<A, EntryLife>& x) {
  a(x.time_to_live, x.ephemeral, x.only_once);
}

template <class A>
void wire(A& a, WirePart<A, Entry>& x) {
  a(x.address, x.version, x.value, x.writer, x.life);
}

template <class A>
void wire(A& a, WirePart<A, WriteRequest>& x) {
  a(x.operation, x.address, x.value, x.last_seen, x.client, x.token, x.life, x.expected);
  if constexpr (!A::writes)
    if (x.operation != Operation::remove && !x.value.has_value())
      throw DecodeError("a write of nothing");
}

template <class A>
void wire(A& a, WirePart<A, BatchRequest>& x) {
  a(x.subarchitecture, x.writes);
}

template <class A>
void wire(A& a, WirePart<A, Patience>& x) {
  a(nullable(x.client), x.number, x.at_most);
}

template <class A>
void wire(A& a, WirePart<A, ReadRequest>& x) {
  a(x.address, x.patience);
}

template <class A>
void wire(A& a, WirePart<A, TypeQuery>& x) {
  a(x.subarchitecture, x.type, x.count, x.with_derived, x.predicate);
}

template <class A>
void wire(A& a, WirePart<A, QueryRequest>& x) {
  a(x.query, x.patience);
}

template <class A>
void wire(A& a, WirePart<A, ExistsQuery>& x) {
  a(x.address);
}

template <class A>
void wire(A& a, WirePart<A, VersionQuery>& x) {
  a(x.address);
}

// -- leases

template <class A>
void wire(A& a, WirePart<A, LockRequest>& x) {
  a(x.address, x.level, x.patience);
  if constexpr (!A::writes)
    if (!x.patience.client)
      throw DecodeError("a lock that nobody asks for");
}

template <class A>
void wire(A& a, WirePart<A, Lease>& x) {
  a(x.token, x.level, x.expires);
}

template <class A>
void wire(A& a, WirePart<A, UnlockRequest>& x) {
  a(x.address, x.client, x.token);
}

template <class A>
void wire(A& a, WirePart<A, CancelWait>& x) {
  a(x.address, x.client, x.number);
}

template <class A>
void wire(A& a, WirePart<A, HeldToken>& x) {
  a(x.id, x.token);
}

template <class A>
void wire(A& a, WirePart<A, RenewRequest>& x) {
  a(x.client, x.leases);
}

template <class A>
void wire(A& a, WirePart<A, RenewReply>& x) {
  a(x.lost);
}

template <class A>
void wire(A& a, WirePart<A, LockQuery>& x) {
  a(x.address);
}

template <class A>
void wire(A& a, WirePart<A, LockStatus>& x) {
  a(x.level, nullable(x.holder), x.waiting);
}

template <class A>
void wire(A& a, WirePart<A, WaitEdge>& x) {
  a(x.kind, x.waiter, x.number, x.since, x.address, x.what, x.obstacle);
}

template <class A>
void wire(A& a, WirePart<A, DeadlockProbe>& x) {
  a(x.path, x.round);
}

// -- events

template <class A>
void wire(A& a, WirePart<A, ChangeFilter>& x) {
  a(x.operation, x.type, x.id, x.source, x.subarchitecture, x.changing, x.predicate);
}

template <class A>
void wire(A& a, WirePart<A, Subscribe>& x) {
  a(x.id, x.filter, x.stream, x.queue_limit, x.component);
}

template <class A>
void wire(A& a, WirePart<A, Unsubscribe>& x) {
  a(x.id);
}

template <class A>
void wire(A& a, WirePart<A, ChangeEvent>& x) {
  a(x.operation, x.address, x.source, x.type, x.version, x.sequence, x.time, x.changed,
    x.coalesced);
}

template <class A>
void wire(A& a, WirePart<A, ChangeNotice>& x) {
  a(x.event, x.filters);
}

template <class A>
void wire(A& a, WirePart<A, ChangeNotices>& x) {
  a(x.notices);
}

template <class A>
void wire(A& a, WirePart<A, EventsTaken>& x) {
  a(x.stream, x.count);
}

template <class A>
void wire(A& a, WirePart<A, Interest>& x) {
  a(x.subarchitecture, x.id, x.filter, x.wanted);
}

template <class A>
void wire(A& a, WirePart<A, ForwardedEvent>& x) {
  a(x.event, x.interests);
}

template <class A>
void wire(A& a, WirePart<A, ForwardedEvents>& x) {
  a(x.events);
}

template <class A>
void wire(A& a, WirePart<A, RoutedEvent>& x) {
  a(x.event, x.receivers);
}

template <class A>
void wire(A& a, WirePart<A, RoutedEvents>& x) {
  a(x.events);
}

// -- a working memory as a whole

template <class A>
void wire(A& a, WirePart<A, Peers>& x) {
  a(x.working_memories, x.routes);
}

template <class A>
void wire(A&, WirePart<A, Acknowledged>&) {}

template <class A>
void wire(A&, WirePart<A, StatusQuery>&) {}

template <class A>
void wire(A& a, WirePart<A, JournalStatus>& x) {
  a(x.mode, x.bytes, x.unsynced, x.held, x.syncs, x.incarnation, x.failure);
}

template <class A>
void wire(A& a, WirePart<A, WorkingMemoryStatus>& x) {
  a(x.subarchitecture, x.entries, x.entries_by_type, x.filters, x.events, x.matched, x.delivered,
    x.coalesced, x.suppressed, x.backlog, x.forwarded, x.routed, x.refused, x.leases, x.waiting,
    x.journal);
}

template <class A>
void wire(A&, WirePart<A, UsageQuery>&) {}

template <class A>
void wire(A& a, WirePart<A, Usage>& x) {
  a(x.component, x.subarchitecture, x.type, x.adds, x.overwrites, x.deletes, x.reads, x.events);
}

template <class A>
void wire(A& a, WirePart<A, UsageReport>& x) {
  a(x.usages);
}

// -- components

template <class A>
void wire(A& a, WirePart<A, caf::actor>& x) {
  if constexpr (A::writes)
    a(caf::actor_cast<caf::strong_actor_ptr>(x));
  else
    x = caf::actor_cast<caf::actor>(a.template take<caf::strong_actor_ptr>());
}

template <class A>
void wire(A& a, WirePart<A, EnterPhase>& x) {
  a(x.phase, x.phase_controller);
}

template <class A>
void wire(A& a, WirePart<A, PhaseDone>& x) {
  a(x.component, x.phase, x.failure);
}

template <class A>
void wire(A& a, WirePart<A, TaskOptions>& x) {
  a(x.priority, x.cost, x.after);
}

template <class A>
void wire(A& a, WirePart<A, TaskProposal>& x) {
  a(x.id, x.name, x.component, x.options);
}

template <class A>
void wire(A& a, WirePart<A, ProposeTask>& x) {
  a(x.proposal);
}

template <class A>
void wire(A& a, WirePart<A, RetractTask>& x) {
  a(x.id);
}

template <class A>
void wire(A& a, WirePart<A, CompleteTask>& x) {
  a(x.id, x.outcome);
}

template <class A>
void wire(A& a, WirePart<A, TaskDecided>& x) {
  a(x.id, x.decision, x.reason);
}

template <class A>
void wire(A& a, WirePart<A, PullRequest>& x) {
  a(x.type);
}

template <class A>
void wire(A& a, WirePart<A, PushRequest>& x) {
  a(x.type, x.limit, x.subscriber);
}

template <class A>
void wire(A& a, WirePart<A, Pushed>& x) {
  a(x.provider, x.value);
}

template <class A>
void wire(A& a, WirePart<A, PushesTaken>& x) {
  a(x.type, x.count);
}

} // namespace castor
