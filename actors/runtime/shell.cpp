#include "castor/actors/runtime/shell.hpp"

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/runtime/component_actions.hpp"
#include "castor/actors/runtime/component_calls.hpp"
#include "castor/actors/runtime/running_components.hpp"
#include "castor/base/at_exit.hpp"
#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"
#include "castor/base/text.hpp"
#include "castor/wm/entries/working_memory_name.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <utility>

namespace castor {

namespace {

using Clock = ComponentShell::Clock;

/// Bytes of what an exception says. More helps nobody, and it is logged, sent and shown again and
/// again.
constexpr std::size_t longest_failure = 4000;

constexpr const char* unknown_exception = "an exception that is no std::exception";

constexpr auto never = Clock::time_point::max();

constexpr CodeActivity in_configure{"configure()"};
constexpr CodeActivity in_start{"start()"};
constexpr CodeActivity in_run{"run()"};
constexpr CodeActivity in_injected_crash{"an injected crash"};

} // namespace

ComponentShell::EventQueueOptions ComponentShell::event_queue_of(const Component& component) {
  if (auto* x = dynamic_cast<const SubarchitectureComponent*>(&component))
    return {x->queue_, x->queue_limit_};
  return {};
}

ComponentShell::ComponentShell(caf::actor_config& config, ShellParts parts, ActorThread thread)
  : PumpedActor(config, parts.services->clock, parts.record->identity().number, thread),
    component_(std::move(parts.component)), record_(std::move(parts.record)),
    services_(std::move(parts.services)), unit_(parts.unit),
    event_queue_(event_queue_of(*component_)),
    context_(*record_, *services_, component_->deadline_, component_->push_limit_),
    code_(*record_, faults_),
    inbox_(receivers_, record_->counters, event_queue_.mode, event_queue_.limit),
    client_({*this, context_, life_, faults_, code_, *unit_}),
    operations_(
      {context_, client_, inbox_, receivers_, event_queue_.limit, !shares_threads(), open_}),
    providers_({*this, context_, client_}), connections_({*this, context_, providers_, code_}),
    commands_({*this, context_, providers_, code_}),
    tasks_(*component_, {*this, context_, faults_, code_}) {
  record_->set_budget(component_->budget_);
  code_.crash_note().describe(identity().full_name(), identity().class_name, parts.where,
                              component_->isolate_);
  component_->attach(*this);
}

std::unique_ptr<Calls> ComponentShell::make_calls(SubarchitectureComponent& component) {
  return std::make_unique<ComponentCalls>(
    component, ComponentCalls::Parts{context_, client_, operations_, inbox_});
}

std::unique_ptr<Actions> ComponentShell::make_actions(SubarchitectureComponent& component) {
  return std::make_unique<ComponentActions>(
    component, ActionParts{*this, context_, client_, operations_, inbox_});
}

// -- life

void ComponentShell::act() {
  begin_activity();
  context(unit_);
  thread_ = std::this_thread::get_id();
  record_->thread_begins();
  CrashWatch watch{code_.crash_note()};
  RunningComponent running{*record_};
  AtExit thread_ends{[this] { record_->thread_ends(); }};
  live([this] { live_on_thread(); });
  run_stop_hook();
  end_component(running);
  if (record_->state() == ComponentState::failed)
    fail_state(caf::make_error(caf::sec::runtime_error, record_->failure()));
}

void ComponentShell::end_component(RunningComponent& running) {
  record_->set_idle();
  // Leases that are members of the component are given back without waiting for the answers.
  life_.stop();
  // A destructor may take its time, too.
  running.begin_destructor();
  record_->enter_user_code(Clock::now());
  component_.reset();
  record_->set_idle();
  forget_actors();
  if (record_->state() != ComponentState::failed)
    record_->set_state(ComponentState::stopped);
}

bool ComponentShell::live(const std::function<void()>& f) {
  try {
    f();
    return true;
  } catch (const ComponentStopped&) {
    // The normal way to end.
  } catch (const InjectedCrash&) {
    if (component_->isolate_) {
      code_.set_activity(in_injected_crash);
      std::abort();
    }
    life_.leave_configure();
    fail("injected crash");
  } catch (const WorkingMemoryLostException& e) {
    auto& lost = e.address().subarchitecture;
    if (life_.is_working_memory_lost())
      record_->set_orphaned();
    else if (!lost.empty() && lost != identity().subarchitecture)
      record_->set_waited_for(working_memory_of(lost));
    fail(e.what());
  } catch (const ProviderDown& e) {
    record_->set_waited_for(e.provider());
    fail(e.what());
  } catch (const std::exception& e) {
    fail(plain_words(e));
  } catch (...) {
    fail(unknown_exception);
  }
  return false;
}

void ComponentShell::live_on_thread() {
  await_phase(Phase::configure);
  configure_component();
  await_phase(Phase::start);
  start_component();
  record_->set_state(ComponentState::started);
  phase_done(Phase::start, {});
  await_phase(Phase::run);
  run_component();
  while (deliver_until(never, nullptr)) {
    // Only callbacks from now on.
  }
}

void ComponentShell::configure_component() {
  code_.set_activity(in_configure);
  if (event_queue_.limit < least_queue_limit)
    throw std::invalid_argument(fmt::format("--queue-limit is {}, but the least is {}",
                                            event_queue_.limit, least_queue_limit));
  if (context_.push_limit() == 0)
    throw std::invalid_argument("--push-limit is 0, but the least is 1");
  code_.run(in_configure, [this] {
    faults_.in_phase(Phase::configure);
    component_->configure();
  });
  life_.leave_configure();
  record_->set_state(ComponentState::configured);
  phase_done(Phase::configure, {});
}

void ComponentShell::start_component() {
  code_.set_activity(in_start);
  // Task managers have no filters.
  if (services_->broadcast && dynamic_cast<SubarchitectureComponent*>(component_.get()))
    operations_.receive_broadcasts();
  code_.run(in_start, [this] {
    faults_.in_phase(Phase::start);
    component_->start();
  });
}

void ComponentShell::run_component() {
  code_.set_activity(in_run);
  code_.run(in_run, [this] {
    record_->set_state(ComponentState::running);
    component_->run();
  });
}

void ComponentShell::run_last_code(const std::function<void()>& f) {
  try {
    f();
  } catch (const ComponentStopped&) {
    // It asked once more and was told once more.
  } catch (const InjectedCrash&) {
    fail("injected crash");
  } catch (const std::exception& e) {
    fail(plain_words(e));
  } catch (...) {
    fail(unknown_exception);
  }
}

void ComponentShell::run_stop_hook() {
  run_last_code([this] { commands_.take_safe_states(); });
  if (!life_.has_started() || record_->state() == ComponentState::failed)
    return;
  life_.enter_stop_hook();
  run_last_code([this] { code_.run("stop()", [this] { component_->stop(); }); });
}

void ComponentShell::await_phase(Phase phase) {
  record_->set_idle();
  while (!life_.try_enter(phase)) {
    if (life_.is_stopping())
      throw ComponentStopped{};
    faults_.at_runtime();
    if (life_.has_started()) {
      commands_.work();
      run_timers();
    }
    if (life_.has_started() && !inbox_.is_empty())
      handle_next();
    else
      wait_for_work(never);
  }
}

void ComponentShell::phase_done(Phase phase, std::string failure) {
  if (phase_controller_)
    send(phase_controller_, PhaseDone{identity().number, phase, std::move(failure)});
}

void ComponentShell::fail(const std::string& what) {
  auto report = "failed in " + code_.activity() + ": " + shorten(what, longest_failure);
  // Whose configuration is wrong in the first life is named by who started the system.
  bool is_refused = life_.is_configuring() && identity().incarnation == 1;
  log_runtime(is_refused ? LogLevel::debug : LogLevel::error, identity().full_name(), report);
  record_->fail(std::move(report));
  if (life_.is_configuring())
    phase_done(Phase::configure, what);
}

void ComponentShell::forget_actors() {
  inbox_.clear();
  open_.clear();
  tasks_.clear();
  connections_.clear();
  commands_.clear();
  timers_ = {};
  phase_controller_ = nullptr;
  context_.forget_neighbours();
}

// -- work

std::function<void()> ComponentShell::waker() {
  return [self = caf::weak_actor_ptr{ctrl()}] {
    if (auto shell = self.lock())
      shell->enqueue(nullptr, caf::make_message_id(), caf::make_message(LookAgain{}), nullptr);
  };
}

bool ComponentShell::deliver(std::optional<std::chrono::nanoseconds> duration,
                             const std::function<bool()>& enough) {
  auto now = context_.time_point();
  bool is_limited = duration && *duration < never - now;
  return deliver_until(is_limited ? now + *duration : never, enough);
}

bool ComponentShell::deliver_until(Clock::time_point until, const std::function<bool()>& enough) {
  UserCode::Pause pause{code_};
  for (;;) {
    file_arrived();
    if (life_.is_stopping())
      return false;
    faults_.at_runtime();
    check_working_memory();
    commands_.work();
    run_timers();
    if (inbox_.is_empty()) {
      record_->set_idle();
      if (!wait_for_work(until))
        return true;
      continue;
    }
    handle_next();
    if ((enough && enough()) || (until != never && context_.time_point() >= until))
      return true;
  }
}

void ComponentShell::check_working_memory() const {
  if (life_.is_working_memory_lost())
    throw WorkingMemoryLostException{
      {FailureKind::working_memory_lost,
       "the working memory of " + identity().subarchitecture + " has ended",
       {identity().subarchitecture, {}}}};
}

bool ComponentShell::wait_for_work(Clock::time_point until) {
  auto pump_to = [this](Clock::time_point x) {
    if (!simulated_clock())
      return pump(x);
    return pump_until(x == never ? Timestamp::max() : context_.since_start(x));
  };
  auto alarm = std::min(commands_.next_alarm(), timers_.next());
  if (alarm >= until)
    return pump_to(until);
  pump_to(alarm);
  return true;
}

void ComponentShell::run_timers() {
  if (timers_.is_empty())
    return;
  for (auto& [id, call] : timers_.take_due(context_.time_point()))
    if (timers_.contains(id) && !life_.is_stopping())
      code_.run("the call of a timer", *call);
}

void ComponentShell::handle_next() {
  auto x = inbox_.take();
  handle(x);
}

void ComponentShell::handle(Inbox::Work& x) {
  if (auto* notice = std::get_if<ChangeNotice>(&x))
    return handle_change(*notice);
  if (auto* task = std::get_if<Inbox::Task>(&x))
    return code_.run(task->what, task->run);
  auto& message = *std::get<caf::mailbox_element_ptr>(x);
  if (!connections_.handle(message) && !commands_.handle(message))
    tasks_.handle(message);
}

void ComponentShell::handle_change(const ChangeNotice& notice) {
  acknowledge(inbox_.delivered());
  // The receivers as they are now; a callback may remove any of them, or add some for later events.
  for (auto& receiver : receivers_.of(notice.filters)) {
    if (life_.is_stopping())
      return;
    if (receivers_.contains(receiver->id))
      code_.run_callback(CodeActivity{"the callback for ", notice.event.get()},
                         [&] { receiver->callback(*notice.event); });
  }
}

} // namespace castor
