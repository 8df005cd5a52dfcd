#include "castor/tools/simulation/simulated_coordinator.hpp"

#include "castor/actors/node/part_agent.hpp"
#include "castor/actors/supervision/supervisor.hpp"

#include <map>
#include <stdexcept>
#include <utility>

namespace castor::simulation {

using namespace std::chrono_literals;

void SimulatedCoordinator::start(const ArchitectureDescription& architecture, Reports reports,
                                 caf::actor_clock::time_point epoch) {
  options_.open_access = true;
  options_.part_patience = 5s;
  // Longer than anybody hangs: who does not stop is not started again.
  options_.stop_patience = 3s;
  options_.link = SimulatedMachines::link_options();
  options_.on_down = std::move(reports.on_down);
  options_.on_up = std::move(reports.on_up);
  for (std::size_t x = 1; x < machines_.count(); ++x)
    machines_.start_node(x);
  processes_.emplace(
    system_, options_, "simulated", [this](const LinkNews& x) { caf::anon_send(supervisor_, x); },
    machines_.spawn_link(0));
  spawn_supervisor(epoch);
  spawn_agent();
  std::map<std::string, Endpoint> nodes;
  for (std::size_t x = 1; x < machines_.count(); ++x)
    nodes[std::string{machine_names[x]}] = SimulatedMachines::endpoint_of(x);
  auto placement = place(architecture, nodes);
  processes_->open(placement);
  deploy(architecture, placement);
}

void SimulatedCoordinator::spawn_supervisor(caf::actor_clock::time_point epoch) {
  end_listener_ = system_.spawn([this]() -> caf::behavior {
    return {[this](const EndSystem& x) { ended_.emplace(x.reason); }};
  });
  SupervisorParts parts;
  parts.processes = &*processes_;
  parts.options = &options_;
  parts.epoch = epoch;
  parts.seed = world_.random();
  parts.end_listener = end_listener_;
  parts.on_change = [](const SystemRosterPtr&) {};
  supervisor_ = system_.spawn(supervisor, std::move(parts));
  world_.expect_no_exception(supervisor_, "the supervisor");
}

void SimulatedCoordinator::spawn_agent() {
  PartAgentParts parts;
  parts.mesh = processes_->mesh();
  parts.messages = processes_->messages();
  parts.spawn = machines_.spawn(0);
  agent_ = system_.spawn(part_agent, std::move(parts));
  world_.expect_no_exception(agent_, "the agent of the coordinator's part");
  processes_->set_own_agent(agent_);
}

void SimulatedCoordinator::deploy(const ArchitectureDescription& architecture,
                                  const Placement& placement) {
  StartComponents start;
  for_each_component(architecture, [&](auto& x) { start.names.push_back(x.name); });
  phase_controller_ = system_.spawn([this, start, deploy = Deploy{architecture, placement}](
                                      caf::event_based_actor* self) -> caf::behavior {
    self->request(supervisor_, caf::infinite, deploy).then([this, self, start](const Deployed& x) {
      if (!x.problems.empty())
        throw std::runtime_error(render(x.problems));
      self->request(supervisor_, caf::infinite, start).then([this](ComponentsStarted) {
        started_ = true;
      });
    });
    return {[](Acknowledged) {}};
  });
}

void SimulatedCoordinator::end() {
  for (auto* x : {&supervisor_, &agent_, &end_listener_, &phase_controller_})
    caf::anon_send_exit(std::exchange(*x, nullptr), caf::exit_reason::kill);
}

void SimulatedCoordinator::close() {
  if (processes_)
    processes_->mesh()->close();
}

} // namespace castor::simulation
