#include "castor/tools/simulation/simulated_component.hpp"

#include "castor/base/log.hpp"

#include <algorithm>
#include <utility>

namespace castor::simulation {

namespace {

constexpr FilterId all_changes = 1;

} // namespace

void SystemWorld::expect_no_exception(const caf::actor& x, const std::string& what) {
  caf::actor_cast<caf::abstract_actor*>(x)->attach_functor([this, what](const caf::error& reason) {
    // What actors end with on purpose has a text.
    if (!over && reason == caf::sec::runtime_error && reason.context().empty())
      find(what + " ended with an exception that nothing caught");
  });
}

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
    if (manager_)
      manager_->abandoned(x.source);
    if (!home_ || x.source != home_.address())
      return;
    record_->set_orphaned();
    fail("its working memory has ended");
  });
  return caf::message_handler{
    [this](const NeighboursPtr& x) { meet(x); },
    [this](const EnterPhase& x) { enter(x); },
    [this](const ComponentFault&) { fail("injected crash"); },
    [this](const ChangeNotice& x) { hear(x); },
    [this](const ChangeNotices& x) {
      for (auto& notice : x.notices)
        hear(notice);
    },
    [this](const ProposeTask& x) {
      if (!manager_)
        return;
      monitor(current_sender());
      system_world_.tasks.received(x.proposal.id, life());
      manager_->propose(x.proposal, caf::actor_cast<caf::actor>(current_sender()));
    },
    [this](const RetractTask& x) {
      if (manager_)
        manager_->retract(x.id);
    },
    [this](const CompleteTask& x) {
      if (manager_)
        manager_->complete(x.id, x.outcome);
    },
    [this](const TaskDecided& x) { decided(x); },
    [this](const TaskDone& x) { complete(x.id); },
    [this](const CallTimeout& x) {
      if (calls_)
        calls_->time_out(x.id);
    },
    [this](const MakeCall& x) {
      auto promise = make_response_promise<bool>();
      call(x.subarchitecture, [promise](bool replied) mutable { promise.deliver(replied); });
      return promise;
    },
  }
    .or_else(SimulatedClient::make_behavior());
}

void SimulatedComponent::on_exit() {
  trace("ends");
  SimulatedClient::on_exit();
  neighbours_ = nullptr;
  home_ = nullptr;
  phase_controller_ = nullptr;
  manager_.reset();
  calls_.reset();
  if (system_world_.over)
    return;
  end_of_life();
  system_world_.tasks.ended(record_->identity().name, record_->identity().incarnation);
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
  if (calls_)
    calls_->meet(neighbours_);
  if (home_)
    return;
  auto& known = neighbours_->working_memories;
  if (auto i = known.find(record_->identity().subarchitecture); i != known.end()) {
    home_ = i->second;
    monitor(home_);
  }
}

void SimulatedComponent::enter(const EnterPhase& x) {
  phase_controller_ = x.phase_controller;
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
        begin_to_manage();
        started();
      }
      break;
    case Phase::run:
      record_->set_state(ComponentState::running);
      system_world_.note(record_->identity().name);
      if (!operates_)
        break;
      go_on();
      propose_tasks();
      if (system_world_.calls.calls_left > 0 && system_world_.chance(60)) {
        --system_world_.calls.calls_left;
        auto& to = system_world_.working_memories[system_world_.pick(3)].subarchitecture;
        call(to, [](bool) {});
      }
      break;
  }
}

void SimulatedComponent::register_filter() {
  Subscribe subscribe{all_changes, any_change().anywhere()};
  subscribe.component = record_->identity().name;
  request(home_, std::chrono::seconds{10}, subscribe)
    .then(
      [this](const Outcome<Acknowledged>& x) {
        if (!x)
          return fail(x.failure().message);
        system_world_.told.push_back(told_);
        if (!system_world_.serves_calls)
          return started();
        calls_.emplace(SimulatedCalls::Parts{this, &system_world_.calls, home_, record_client()},
                       neighbours_);
        calls_->begin([this](bool registered) {
          registered ? started() : fail("its filters were not registered");
        });
      },
      [this](const caf::error&) { fail("its filter was not registered"); });
}

void SimulatedComponent::started() {
  record_->set_state(ComponentState::started);
  phase_done(Phase::start);
}

ClientPtr SimulatedComponent::record_client() const {
  auto& identity = record_->identity();
  return std::make_shared<const castor::Client>(
    castor::Client{identity.name, identity.subarchitecture, identity.incarnation});
}

// -- tasks

void SimulatedComponent::begin_to_manage() {
  manager_.emplace(system_world_.task_rules, [this](const caf::actor& to, const TaskDecided& x) {
    auto wrong = system_world_.tasks.decided(x, life(), system_world_.task_rules.budget);
    if (!wrong.empty())
      system_world_.find(record_->identity().name + " " + wrong);
    send(to, x);
  });
}

caf::actor SimulatedComponent::manager_of_tasks() const {
  auto& known = neighbours_->task_managers;
  auto i = known.find(record_->identity().subarchitecture);
  return i == known.end() ? caf::actor{} : i->second;
}

void SimulatedComponent::propose_tasks() {
  auto& world = system_world_;
  auto manager = manager_of_tasks();
  if (!manager)
    return;
  for (auto count = 1 + world.pick(3); count > 0 && world.tasks_left > 0; --count) {
    --world.tasks_left;
    auto& identity = record_->identity();
    TaskProposal task;
    auto prefix = identity.name + ':' + std::to_string(identity.incarnation) + ':';
    task.id = prefix + std::to_string(++last_task_);
    task.name = "work";
    task.component = identity.name;
    task.options.priority = int(world.pick(3));
    // More than the budget now and then.
    task.options.cost = world.chance(8) ? 3 : 0.5 * double(1 + world.pick(3));
    if (last_task_ > 1 && world.chance(40))
      task.options.after.push_back(prefix + std::to_string(1 + world.pick(last_task_ - 1)));
    world.tasks.proposed(task, life());
    tasks_[task.id] = task;
    send(manager, ProposeTask{task});
  }
}

void SimulatedComponent::decided(const TaskDecided& x) {
  auto& world = system_world_;
  if (tasks_.count(x.id) == 0)
    return;
  world.note(x.id);
  world.note(std::uint64_t(x.decision));
  switch (x.decision) {
    case TaskDecision::rejected:
      tasks_.erase(x.id);
      break;
    case TaskDecision::adopted:
      delayed_send(this, std::chrono::milliseconds{1 + world.pick(50)}, TaskDone{x.id});
      break;
    case TaskDecision::waiting:
      if (!world.chance(15))
        break;
      world.tasks.retracted(x.id);
      tasks_.erase(x.id);
      if (auto manager = manager_of_tasks())
        send(manager, RetractTask{x.id});
      break;
  }
}

void SimulatedComponent::complete(const TaskId& id) {
  auto& world = system_world_;
  if (tasks_.erase(id) == 0)
    return;
  auto outcome = world.chance(80)   ? TaskOutcome::success
                 : world.chance(50) ? TaskOutcome::failure
                                    : TaskOutcome::incomplete;
  world.tasks.completed(id, outcome);
  if (auto manager = manager_of_tasks())
    send(manager, CompleteTask{id, outcome});
  if (world.chance(50))
    propose_tasks();
}

// -- calls

void SimulatedComponent::call(const std::string& subarchitecture,
                              SimulatedCalls::Answered answered) {
  if (calls_)
    calls_->call(subarchitecture, std::move(answered));
  else
    answered(false);
}

void SimulatedComponent::phase_done(Phase phase) {
  if (phase_controller_)
    send(phase_controller_, PhaseDone{record_->identity().number, phase, {}});
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
  // Whatever else of its filters wants the event, this one wants all.
  if (std::ranges::count(x.filters, all_changes) > 0) {
    told_->events.push_back(x.event);
    told_->times.push_back(system_world_.recorder.now());
  }
  if (calls_)
    calls_->take(x);
  if (log_level() <= LogLevel::debug)
    trace("is told of " + std::to_string(x.event->sequence) + ", " + to_string(*x.event));
  system_world_.note(x.event->sequence);
}

} // namespace castor::simulation
