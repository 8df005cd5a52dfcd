#include "castor/tests/simulation/simulated_component.hpp"

#include "castor/actors/component/log.hpp"

#include <utility>

namespace castor::simulation {

SimulatedComponent::SimulatedComponent(caf::actor_config& config, SystemWorld& world,
                                       linearizability::SimulatedClientParts parts,
                                       std::shared_ptr<ComponentRecord> record, bool operates,
                                       Life process)
  : SimulatedClient(config, std::move(parts)), system_world_(world), record_(std::move(record)),
    operates_(operates), process_(process) {
  auto& identity = record_->identity();
  told_->component = identity.name;
  told_->incarnation = identity.incarnation;
  told_->process = process;
  system_world_.components[identity.name] = this;
  system_world_.owners[this] = process;
  record_->set_budget(std::chrono::seconds{10});
  trace("is made");
}

caf::behavior SimulatedComponent::make_behavior() {
  set_exit_handler([this](const caf::exit_msg&) {
    record_->set_state(ComponentState::stopped);
    quit(caf::exit_reason::user_shutdown);
  });
  set_down_handler([this](const caf::down_msg& x) {
    if (!home_ || x.source != home_.address())
      return;
    record_->set_orphaned();
    fail("its working memory has ended");
  });
  return caf::message_handler{
    [this](const NeighboursPtr& x) { meet(x); },
    [this](const EnterPhase& x) { enter(x); },
    [this](const ComponentFault&) { fail("it was made to crash"); },
    [this](const ChangeNotice& x) { hear(x); },
    [this](const ChangeNotices& x) {
      for (auto& notice : x.notices)
        hear(notice);
    },
  }
    .or_else(SimulatedClient::make_behavior());
}

void SimulatedComponent::on_exit() {
  trace("ends");
  SimulatedClient::on_exit();
  neighbours_ = nullptr;
  home_ = nullptr;
  conductor_ = nullptr;
  if (system_world_.over)
    return;
  end_of_life();
  told_->alive = false;
  system_world_.owners.erase(this);
  auto i = system_world_.components.find(record_->identity().name);
  if (i != system_world_.components.end() && i->second == this)
    system_world_.components.erase(i);
}

WorkingMemoryActor SimulatedComponent::way_to(std::size_t working_memory) const {
  if (working_memory == parts().home)
    return home_;
  auto& name = system_world_.working_memories[working_memory].subarchitecture;
  auto i = neighbours_->working_memories.find(name);
  return i == neighbours_->working_memories.end() ? WorkingMemoryActor{} : i->second;
}

Timestamp SimulatedComponent::pause() {
  auto longest = std::size_t(system_world_.longest_pause.count());
  return std::chrono::milliseconds{system_world_.pick(longest)};
}

void SimulatedComponent::meet(NeighboursPtr neighbours) {
  neighbours_ = std::move(neighbours);
  if (home_)
    return;
  auto& known = neighbours_->working_memories;
  if (auto i = known.find(record_->identity().subarchitecture); i != known.end()) {
    home_ = i->second;
    monitor(home_);
  }
}

void SimulatedComponent::enter(const EnterPhase& x) {
  conductor_ = x.conductor;
  trace("enters phase " + std::to_string(int(x.phase)));
  switch (x.phase) {
    case Phase::configure:
      record_->set_state(ComponentState::configured);
      phase_done(Phase::configure);
      break;
    case Phase::start:
      if (!home_) {
        record_->set_orphaned();
        fail("its working memory is not there");
      } else if (operates_) {
        register_filter();
      } else {
        record_->set_state(ComponentState::started);
        phase_done(Phase::start);
      }
      break;
    case Phase::run:
      record_->set_state(ComponentState::running);
      system_world_.note(record_->identity().name);
      if (operates_)
        go_on();
      break;
  }
}

void SimulatedComponent::register_filter() {
  Subscribe subscribe{1, any_change().anywhere()};
  subscribe.component = record_->identity().name;
  request(home_, std::chrono::seconds{10}, subscribe)
    .then(
      [this](const Outcome<Acknowledged>& x) {
        if (!x)
          return fail(x.failure().message);
        system_world_.told.push_back(told_);
        record_->set_state(ComponentState::started);
        phase_done(Phase::start);
      },
      [this](const caf::error&) { fail("its filter was not taken note of"); });
}

void SimulatedComponent::phase_done(Phase phase) {
  if (conductor_)
    send(conductor_, PhaseDone{record_->identity().number, phase, {}});
}

void SimulatedComponent::fail(const std::string& why) {
  record_->fail(why);
  quit(caf::make_error(caf::sec::runtime_error, why));
}

void SimulatedComponent::trace(const std::string& what) const {
  if (log_level() <= LogLevel::debug)
    log(LogLevel::debug, record_->identity().name,
        "in its life " + std::to_string(record_->identity().incarnation) + ", in process " +
          std::to_string(process_) + ", at " +
          std::to_string(system_world_.recorder.now().count() / 1000) + " ms: " + what);
}

void SimulatedComponent::hear(const ChangeNotice& x) {
  told_->events.push_back(x.event);
  if (log_level() <= LogLevel::debug)
    trace("is told of " + std::to_string(x.event->sequence) + ", " + to_string(*x.event));
  system_world_.note(x.event->sequence);
}

} // namespace castor::simulation
