#pragma once

#include "castor/actors/link/wire_table.hpp"
#include "castor/actors/node/clock_protocol.hpp"
#include "castor/actors/node/component_wire.hpp"
#include "castor/actors/node/part_protocol.hpp"

/// Wire form of the messages between a coordinator and the parts of its system.
namespace castor {

CASTOR_WIRE_ENUM(Severity, note)
CASTOR_WIRE_ENUM(ComponentKind, standalone)
CASTOR_WIRE_ENUM(Language, python)
CASTOR_WIRE_ENUM(RestartStrategy, rest_for_one)
CASTOR_WIRE_ENUM(ComponentState, failed)
CASTOR_WIRE_ENUM(ComponentEnded::How, orphaned)
CASTOR_WIRE_ENUM(ComponentFault::Kind, slowness)
CASTOR_WIRE_ENUM(JournalFault::Kind, slowness)
CASTOR_WIRE_ENUM(LinkFault::Kind, loss)
CASTOR_WIRE_ENUM(LinkState, lost)
CASTOR_WIRE_ENUM(TaskStep, completed)

/// Includes are not sent: a location is a file and a line.
template <class A>
void wire(A& a, WirePart<A, SourceLocation>& x) {
  if constexpr (A::writes) {
    a(x.file(), static_cast<std::uint64_t>(x.line()));
  } else {
    auto file = a.template take<std::string>();
    x = {std::move(file), static_cast<std::size_t>(a.template take<std::uint64_t>())};
  }
}

CASTOR_WIRE(OptionSetting, key, value, where)
CASTOR_WIRE(ComponentDescription, kind, name, class_name, language, host, options, number,
            subarchitecture, where, line)
CASTOR_WIRE(SubarchitectureDescription, name, host, working_memory, task_manager, components, where)
CASTOR_WIRE(AccessRule, writer, owner, where)
CASTOR_WIRE(ReadRule, reader, owner, where)
CASTOR_WIRE(SupervisionPolicy, strategy, restarts, period, first_delay, longest_delay)
CASTOR_WIRE(SupervisionRule, who, policy, where)
CASTOR_WIRE(FailoverRule, who, hosts, where)
CASTOR_WIRE_EXCEPT(ArchitectureDescription, (left_out), file, config_dir, subarchitectures,
                   standalone, host_names, access_rules, read_rules, supervision, failover)
CASTOR_WIRE(Diagnostic, severity, where, line, expanded, message, remedy, column)
CASTOR_WIRE(ProcessDescription, name, host, port, lost)
CASTOR_WIRE(ClockAdvance, round, time)
CASTOR_WIRE(MessageCounts, sent, received)
CASTOR_WIRE(ClockReport, round, next, counts)
CASTOR_WIRE(ClockReportFrom, from, report)
CASTOR_WIRE(PartPlan, system, architecture, processes, placement, incarnations, temporary,
            open_access, broadcast, operations, pushes, pushes_limit, age, simulated_clock, clock,
            patience, coordinator, supervisor, task_observer)
CASTOR_WIRE(PartMade, problems, actors)
CASTOR_WIRE(JoinParts, actors, processes)
CASTOR_WIRE(RestartComponent, name, incarnation)
CASTOR_WIRE(ComponentEnded, name, incarnation, how, failure, waited_for)
CASTOR_WIRE(ComponentHangs, name, incarnation)
CASTOR_WIRE(FaultTicket, number, observer)
CASTOR_WIRE(FaultHappened, number)
CASTOR_WIRE(ComponentFault, kind, callback, by, duration, ticket)
CASTOR_WIRE(InjectComponentFault, name, fault)
CASTOR_WIRE(LinkFault, kind, duration, by, part, ticket)
CASTOR_WIRE(InjectLinkFault, peer, fault)
CASTOR_WIRE(JumpClock, by)
CASTOR_WIRE(JournalFault, kind, duration, by, ticket)
CASTOR_WIRE(PartStatusQuery)
CASTOR_WIRE(ComponentIdentity, name, subarchitecture, class_name, number, incarnation)
// The coordinator alone knows of restarts.
CASTOR_WIRE_EXCEPT(ComponentStatus, (restarts, will_restart), identity, is_task_manager, state,
                   out_of_reach, failure, busy, cpu, events_received, events_rejected, callbacks,
                   reads, writes, pushes_dropped, obeys)
CASTOR_WIRE(LinkNews, peer, state, reason, name)
CASTOR_WIRE(LinkStatus, news, messages_out, messages_in, bytes_out, bytes_in, events_out, events_in,
            connections, unacknowledged)
CASTOR_WIRE(ProcessUsage, cpu, age, memory_bytes)
CASTOR_WIRE(PartStatus, components, links, usage)
CASTOR_WIRE(EndSystem, status, reason)
CASTOR_WIRE(TaskEvent, step, subarchitecture, task, detail, time)

} // namespace castor
