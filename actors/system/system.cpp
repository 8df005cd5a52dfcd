#include "castor/actors/system/system.hpp"

#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/check.hpp"
#include "castor/actors/node/clock_protocol.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/part_agent.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/system/local_endpoint.hpp"
#include "castor/actors/system/observation.hpp"
#include "castor/actors/system/reconfiguration.hpp"
#include "castor/actors/system/roster_feed.hpp"
#include "castor/actors/system/run_loop.hpp"
#include "castor/actors/system/status_collector.hpp"
#include "castor/actors/system/supervisor_client.hpp"
#include "castor/actors/system/system_faults.hpp"
#include "castor/actors/system/system_inbox.hpp"
#include "castor/wm/clock/clock_control.hpp"

#include <unistd.h>

#include <filesystem>
#include <utility>

namespace castor {

namespace {

using Clock = std::chrono::steady_clock;

/// "vision-1234-77": differs from the names of all other systems.
std::string new_system_name(const ArchitectureDescription& architecture) {
  return std::filesystem::path{architecture.file}.stem().string() + '-' + std::to_string(getpid()) +
         '-' + std::to_string(new_incarnation() % 10'000);
}

Placement checked(Placement x, const ArchitectureDescription& architecture) {
  if (auto problems = problems_of(x, architecture); !problems.empty())
    throw SystemError{std::move(problems)};
  return x;
}

/// Null for the real clock.
std::shared_ptr<Activity> make_activity(const ClockOptions& x, const Placement& placement) {
  if (!x.pace)
    return nullptr;
  if (x.reproducible && placement.processes.size() > 1)
    throw SystemError{{{Severity::error,
                        {},
                        {},
                        {},
                        "a run is reproducible in one process only, and this system needs " +
                          std::to_string(placement.processes.size()),
                        "leave --reproducible out, or run all components in one process"}}};
  return std::make_shared<Activity>(x.reproducible ? Activity::Order::one_at_a_time
                                                   : Activity::Order::parallel);
}

} // namespace

/// Makes the actors of a system and what works with them, and ends them.
struct System::Implementation {
  Implementation(ArchitectureDescription described, SystemOptions with)
    : architecture(std::move(described)), options(std::move(with)),
      placed(checked(place(architecture, options.nodes), architecture)) {
    try {
      make();
    } catch (...) {
      end();
      throw;
    }
  }

  ~Implementation() {
    if (!run_loop.is_stopped())
      run_loop.stop();
    end();
  }

  void end() {
    // Nobody calls this object any more.
    supervisor.end();
    if (clock)
      clock->close();
    // Holds stand-alone components, which hold the observer, whose thread the actor system waits
    // for.
    roster.clear();
    caf::anon_send_exit(endpoint, caf::exit_reason::user_shutdown);
    await_ends(system, {endpoint});
    processes.close("the system has ended");
    caf::anon_send_exit(processes.agent(0), caf::exit_reason::user_shutdown);
    observation.end();
    caf::anon_send_exit(end_listener, caf::exit_reason::user_shutdown);
  }

  void make() {
    // Anybody may end the system, from the moment when there is somebody.
    end_listener = system.spawn([this]() -> caf::behavior {
      return {
        [this](const EndSystem& x) {
          if (clock)
            clock->stand();
          inbox.end(x.status, x.reason);
        },
        [this](const FaultHappened& x) {
          if (options.on_fault_happened)
            options.on_fault_happened(x.number);
        },
      };
    });
    make_supervisor();
    processes.connect(architecture, placed);
    PartAgentParts parts;
    parts.mesh = processes.mesh();
    parts.messages = processes.messages();
    if (clock)
      parts.clock = clock->clock();
    processes.set_own_agent(system.spawn(part_agent, std::move(parts)));
    supervisor.deploy(architecture, placed);
    if (!options.endpoint.empty())
      open_endpoint();
  }

  void make_supervisor() {
    SupervisorParts parts;
    parts.processes = &processes;
    parts.options = &options;
    parts.file = architecture.file;
    parts.epoch = epoch;
    if (clock)
      parts.clock = clock->clock();
    parts.end_listener = end_listener;
    parts.task_observer = observation.task_observer();
    parts.on_change = [this](SystemRosterPtr x) { roster.update(std::move(x)); };
    supervisor.begin(std::move(parts));
  }

  std::shared_ptr<ClockControl> make_clock() {
    if (!config.activity())
      return nullptr;
    ClockControl::Parts parts;
    parts.clock = std::make_shared<SimulatedClock>(config.activity(), ClockAdvance{});
    parts.at_limit = [this](Timestamp x) { inbox.note_limit(x); };
    if (auto& mesh = processes.mesh()) {
      parts.send = [mesh](ClockMember to, const ClockAdvance& x) {
        if (auto clock_there = mesh->well_known(to, clock_number))
          clock_there->enqueue(nullptr, caf::make_message_id(), caf::make_message(x), nullptr);
      };
      parts.counts = [mesh] { return mesh->message_counts(); };
      mesh->set_clock(parts.clock);
    }
    auto result = std::make_shared<ClockControl>(std::move(parts));
    if (auto& mesh = processes.mesh())
      mesh->set_sink(clock_number, [control = result.get()](ProcessNumber, auto& x, auto*) {
        if (x.template match_elements<ClockReportFrom>()) {
          auto& [from, report] = x.template get_as<ClockReportFrom>(0);
          control->receive(from, report);
        }
      });
    result->set_pace(*options.clock.pace);
    return result;
  }

  void on_link_news(const LinkNews& x) {
    if (clock && x.state == LinkState::up)
      clock->add_member(x.peer);
    else if (clock && x.state == LinkState::lost)
      clock->remove_member(x.peer);
    supervisor.tell(x);
  }

  void open_endpoint() {
    auto operations =
      options.operations.empty() ? nullptr : std::make_shared<OperationLog>(options.operations);
    endpoint = open_local_endpoint(
      system, options.endpoint, [this](SystemOrder x) { inbox.add(std::move(x)); },
      std::move(operations), clock);
    roster.set_endpoint(endpoint);
  }

  ArchitectureDescription architecture;
  const SystemOptions options;
  /// As the file has it; `roster` knows better later.
  const Placement placed;
  ActorSystemConfig config{placed.processes.size() > 1 || !options.endpoint.empty(),
                           make_activity(options.clock, placed)};
  caf::actor_system system{config};
  const Clock::time_point epoch = Clock::now();
  SystemInbox inbox;
  RosterFeed roster;
  SupervisorClient supervisor{system, options};
  Processes processes{system, options, new_system_name(architecture),
                      [this](const LinkNews& x) { on_link_news(x); }};
  /// Null for the real clock.
  std::shared_ptr<ClockControl> clock = make_clock();
  caf::actor end_listener;
  caf::actor endpoint;
  StatusCollector status{system, options, architecture, processes, roster};
  Observation observation{system, options, architecture, roster, status};
  Reconfiguration reconfiguration{architecture, options,    processes,
                                  roster,       supervisor, observation};
  RunLoop run_loop{{options, architecture, processes, supervisor, status, observation,
                    reconfiguration, inbox, clock.get()}};
  SystemFaults faults{system, processes, roster, supervisor, end_listener};
};

System::System(ArchitectureDescription architecture, SystemOptions options)
  : implementation_(std::make_unique<Implementation>(std::move(architecture), std::move(options))) {
}

System::~System() = default;

bool System::start() {
  return implementation_->run_loop.start();
}

EndReason System::wait(const Until& until) {
  return implementation_->run_loop.wait(until);
}

std::optional<std::pair<int, std::string>> System::ended() const {
  return implementation_->inbox.ended();
}

void System::catch_up() {
  implementation_->observation.catch_up();
}

void System::stop() {
  implementation_->run_loop.stop();
}

void System::abandon() {
  implementation_->end();
}

std::vector<Diagnostic> System::add(ArchitectureDescription added) {
  return implementation_->reconfiguration.add(std::move(added));
}

std::string System::remove(const std::string& name) {
  return implementation_->reconfiguration.remove(name);
}

FaultPort& System::faults() {
  return implementation_->faults;
}

SystemRosterPtr System::roster() const {
  return implementation_->roster.newest();
}

SystemSummary System::summary() {
  return implementation_->status.summary(implementation_->supervisor.stuck());
}

std::vector<EntryPtr> System::entries(const std::string& subarchitecture) {
  return implementation_->status.entries(subarchitecture);
}

std::vector<std::string> System::subarchitectures() const {
  std::vector<std::string> result;
  for (auto& x : implementation_->architecture.subarchitectures)
    result.push_back(x.name);
  return result;
}

Timestamp System::now() const {
  if (auto& control = implementation_->clock)
    return control->clock()->now();
  return std::chrono::duration_cast<Timestamp>(Clock::now() - implementation_->epoch);
}

std::chrono::steady_clock::time_point System::epoch() const {
  return implementation_->epoch;
}

} // namespace castor
