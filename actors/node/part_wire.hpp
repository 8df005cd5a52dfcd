#pragma once

#include "castor/actors/link/wire_protocol.hpp"
#include "castor/actors/link/wire_table.hpp"
#include "castor/actors/node/part_protocol.hpp"

/// The wire form of what a coordinator and the parts of its system say to each other.
namespace castor {

constexpr Severity last_of(Severity) {
  return Severity::note;
}
constexpr ComponentKind last_of(ComponentKind) {
  return ComponentKind::standalone;
}
constexpr Language last_of(Language) {
  return Language::python;
}
constexpr RestartStrategy last_of(RestartStrategy) {
  return RestartStrategy::rest_for_one;
}
constexpr ComponentState last_of(ComponentState) {
  return ComponentState::failed;
}
constexpr ComponentEnded::How last_of(ComponentEnded::How) {
  return ComponentEnded::How::orphaned;
}
constexpr ComponentFault::Kind last_of(ComponentFault::Kind) {
  return ComponentFault::Kind::slowness;
}
constexpr JournalFault::Kind last_of(JournalFault::Kind) {
  return JournalFault::Kind::slowness;
}
constexpr LinkFault::Kind last_of(LinkFault::Kind) {
  return LinkFault::Kind::loss;
}
constexpr LinkState last_of(LinkState) {
  return LinkState::lost;
}
constexpr TaskStep last_of(TaskStep) {
  return TaskStep::completed;
}

/// Includes are not told of: a place is a file and a line.
template <class A>
void wire(A& a, WirePart<A, SourceLocation>& x) {
  if constexpr (A::writes) {
    a(x.file(), static_cast<std::uint64_t>(x.line()));
  } else {
    auto file = a.template take<std::string>();
    x = {std::move(file), static_cast<std::size_t>(a.template take<std::uint64_t>())};
  }
}

template <class A>
void wire(A& a, WirePart<A, OptionSetting>& x) {
  a(x.key, x.value, x.where);
}

template <class A>
void wire(A& a, WirePart<A, ComponentDescription>& x) {
  a(x.kind, x.name, x.class_name, x.language, x.host, x.options, x.number, x.subarchitecture,
    x.where, x.line);
}

template <class A>
void wire(A& a, WirePart<A, SubarchitectureDescription>& x) {
  a(x.name, x.host, x.working_memory, x.task_manager, x.components, x.where);
}

template <class A>
void wire(A& a, WirePart<A, AccessRule>& x) {
  a(x.writer, x.owner, x.where);
}

template <class A>
void wire(A& a, WirePart<A, SupervisionPolicy>& x) {
  a(x.strategy, x.restarts, x.period, x.first_delay, x.longest_delay);
}

template <class A>
void wire(A& a, WirePart<A, SupervisionRule>& x) {
  a(x.who, x.policy, x.where);
}

template <class A>
void wire(A& a, WirePart<A, FailoverRule>& x) {
  a(x.who, x.hosts, x.where);
}

template <class A>
void wire(A& a, WirePart<A, ArchitectureDescription>& x) {
  a(x.file, x.config_dir, x.subarchitectures, x.standalone, x.host_names, x.access_rules,
    x.supervision, x.failover);
}

template <class A>
void wire(A& a, WirePart<A, Diagnostic>& x) {
  a(x.severity, x.where, x.line, x.expanded, x.message, x.remedy);
}

template <class A>
void wire(A& a, WirePart<A, ProcessDescription>& x) {
  a(x.name, x.host, x.port, x.lost);
}

template <class A>
void wire(A& a, WirePart<A, PartPlan>& x) {
  a(x.system, x.architecture, x.processes, x.placement, x.incarnations, x.temporary, x.open_access,
    x.broadcast, x.operations, x.pushes, x.pushes_limit, x.age, x.patience, x.coordinator,
    x.supervisor, x.task_observer);
}

template <class A>
void wire(A& a, WirePart<A, PartMade>& x) {
  a(x.problems, x.actors);
}

template <class A>
void wire(A& a, WirePart<A, JoinParts>& x) {
  a(x.actors, x.processes);
}

template <class A>
void wire(A& a, WirePart<A, RestartComponent>& x) {
  a(x.name, x.incarnation);
}

template <class A>
void wire(A& a, WirePart<A, ComponentEnded>& x) {
  a(x.name, x.incarnation, x.how, x.failure, x.waited_for);
}

template <class A>
void wire(A& a, WirePart<A, ComponentHangs>& x) {
  a(x.name, x.incarnation);
}

template <class A>
void wire(A& a, WirePart<A, FaultTicket>& x) {
  a(x.number, x.observer);
}

template <class A>
void wire(A& a, WirePart<A, FaultHappened>& x) {
  a(x.number);
}

template <class A>
void wire(A& a, WirePart<A, ComponentFault>& x) {
  a(x.kind, x.callback, x.by, x.duration, x.ticket);
}

template <class A>
void wire(A& a, WirePart<A, InjectComponentFault>& x) {
  a(x.name, x.fault);
}

template <class A>
void wire(A& a, WirePart<A, LinkFault>& x) {
  a(x.kind, x.duration, x.by, x.part, x.ticket);
}

template <class A>
void wire(A& a, WirePart<A, InjectLinkFault>& x) {
  a(x.peer, x.fault);
}

template <class A>
void wire(A& a, WirePart<A, JumpClock>& x) {
  a(x.by);
}

template <class A>
void wire(A& a, WirePart<A, JournalFault>& x) {
  a(x.kind, x.duration, x.by, x.ticket);
}

template <class A>
void wire(A&, WirePart<A, PartStatusQuery>&) {}

template <class A>
void wire(A& a, WirePart<A, ComponentIdentity>& x) {
  a(x.name, x.subarchitecture, x.class_name, x.number, x.incarnation);
}

template <class A>
void wire(A& a, WirePart<A, ComponentStatus>& x) {
  a(x.identity, x.is_task_manager, x.state, x.out_of_reach, x.failure, x.busy, x.cpu,
    x.events_received, x.callbacks, x.reads, x.writes, x.pushes_dropped);
}

template <class A>
void wire(A& a, WirePart<A, LinkNews>& x) {
  a(x.peer, x.state, x.reason, x.name);
}

template <class A>
void wire(A& a, WirePart<A, LinkStatus>& x) {
  a(x.news, x.messages_out, x.messages_in, x.bytes_out, x.bytes_in, x.events_out, x.events_in,
    x.connections, x.unacknowledged);
}

template <class A>
void wire(A& a, WirePart<A, ProcessUsage>& x) {
  a(x.cpu, x.age, x.memory_bytes);
}

template <class A>
void wire(A& a, WirePart<A, PartStatus>& x) {
  a(x.components, x.links, x.usage);
}

template <class A>
void wire(A& a, WirePart<A, EndSystem>& x) {
  a(x.status, x.reason);
}

template <class A>
void wire(A& a, WirePart<A, TaskEvent>& x) {
  a(x.step, x.subarchitecture, x.task, x.detail, x.time);
}

} // namespace castor
