#include "castor/actors/runtime/shell.hpp"

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/task_manager.hpp"
#include "castor/actors/runtime/component_calls.hpp"
#include "castor/actors/runtime/running_components.hpp"
#include "castor/base/plain_words.hpp"
#include "castor/base/text.hpp"
#include "castor/wm/entries/working_memory_name.hpp"

#include <caf/actor_proxy.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace castor {

namespace {

using Clock = PumpedActor::Clock;

/// Bytes of what an exception says. More helps nobody, and it is logged, sent and shown again and
/// again.
constexpr std::size_t longest_failure = 4000;

/// Far enough, and safe to subtract from.
Clock::time_point never() {
  return Clock::now() + std::chrono::hours{24 * 365};
}

std::string phase_name(Phase x) {
  switch (x) {
    case Phase::configure:
      return "configure()";
    case Phase::start:
      return "start()";
    case Phase::run:
      return "run()";
  }
  return {};
}

/// Runs `f` when the scope is left, whichever way.
template <class F>
class AtExit {
public:
  explicit AtExit(F f) : f_(std::move(f)) {}
  AtExit(const AtExit&) = delete;
  AtExit& operator=(const AtExit&) = delete;
  ~AtExit() { f_(); }

private:
  F f_;
};

} // namespace

ComponentShell::ComponentShell(caf::actor_config& config, ShellParts parts)
  : PumpedActor(config), component_(std::move(parts.component)),
    managed_(dynamic_cast<ManagedComponent*>(component_.get())),
    manager_(dynamic_cast<TaskManager*>(component_.get())), record_(std::move(parts.record)),
    services_(std::move(parts.services)), unit_(parts.unit) {
  if (auto* x = dynamic_cast<SubarchitectureComponent*>(component_.get())) {
    queue_mode_ = x->queue_;
    queue_limit_ = x->queue_limit_;
    component_receipts_ = Receipts{queue_limit_};
  }
  record_->set_budget(component_->budget_);
  crash_note_.describe(identity().full_name(), identity().class_name, parts.where,
                       component_->isolate_);
  if (services_->operations)
    recorder_.emplace(*services_->operations, record_->client());
  component_->attach(*this);
}

// -- life

void ComponentShell::act() {
  context(unit_);
  thread_ = std::this_thread::get_id();
  record_->thread_begins();
  CrashWatch watch{crash_note_};
  RunningComponent running{*record_};
  AtExit thread_ends{[this] { record_->thread_ends(); }};
  try {
    live();
  } catch (const ComponentStopped&) {
    // The normal way to end.
  } catch (const InjectedCrash&) {
    if (component_->isolate_) {
      crash_note_.set_doing("an injected crash");
      std::abort();
    }
    in_configure_ = false;
    fail("it was made to crash");
  } catch (const WorkingMemoryLostException& e) {
    auto& lost = e.address().subarchitecture;
    if (working_memory_lost_)
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
    fail("an exception that is no std::exception");
  }
  if (started_ && record_->state() != ComponentState::failed) {
    in_stop_hook_ = true;
    try {
      user_code("stop()", [this] { component_->stop(); });
    } catch (const ComponentStopped&) {
      // It asked once more and was told once more.
    } catch (const std::exception& e) {
      fail(plain_words(e));
    } catch (...) {
      fail("an exception that is no std::exception");
    }
  }
  record_->set_idle();
  // Leases that are members of the component are given back without waiting for the answers.
  stopping_ = true;
  // A destructor may take its time, too.
  running.begin_destructor();
  record_->enter_user_code(Clock::now());
  component_.reset();
  record_->set_idle();
  let_go();
  if (record_->state() != ComponentState::failed)
    record_->set_state(ComponentState::stopped);
  else
    fail_state(caf::make_error(caf::sec::runtime_error, record_->failure()));
}

void ComponentShell::let_go() {
  work_.clear();
  proposers_.clear();
  watched_.clear();
  connections_.clear();
  phase_controller_ = nullptr;
  neighbours_ = nullptr;
}

void ComponentShell::meet(NeighboursPtr neighbours) {
  auto before = std::exchange(neighbours_, std::move(neighbours));
  connections_.meet();
  if (before && on_neighbours_)
    on_neighbours_(*before);
  if (identity().subarchitecture.empty() || working_memory_)
    return;
  auto& known = neighbours_->working_memories;
  auto home = known.find(identity().subarchitecture);
  // Its node is lost, and it will be started again once that is back.
  working_memory_lost_ = home == known.end();
  if (working_memory_lost_)
    return;
  working_memory_ = home->second;
  monitor(working_memory_);
}

void ComponentShell::live() {
  await_phase(Phase::configure);
  in_configure_ = true;
  if (queue_limit_ < least_queue_limit)
    throw std::invalid_argument(
      fmt::format("--queue-limit is {}, but the least is {}", queue_limit_, least_queue_limit));
  if (push_limit() == 0)
    throw std::invalid_argument("--push-limit is 0, but the least is 1");
  user_code(phase_name(Phase::configure), [this] {
    injected_faults_.in_phase(Phase::configure);
    component_->configure();
  });
  in_configure_ = false;
  record_->set_state(ComponentState::configured);
  phase_done(Phase::configure, {});
  await_phase(Phase::start);
  started_ = true;
  user_code(phase_name(Phase::start), [this] {
    injected_faults_.in_phase(Phase::start);
    component_->start();
  });
  record_->set_state(ComponentState::started);
  phase_done(Phase::start, {});
  await_phase(Phase::run);
  record_->set_state(ComponentState::running);
  user_code(phase_name(Phase::run), [this] { component_->run(); });
  while (deliver(never(), nullptr)) {
    // Only callbacks from now on.
  }
}

void ComponentShell::await_phase(Phase phase) {
  record_->set_idle();
  while (phases_.empty() || phases_.front() != phase) {
    if (stopping_)
      throw ComponentStopped{};
    injected_faults_.at_runtime();
    if (started_ && !work_.empty()) {
      auto x = std::move(work_.front());
      work_.pop_front();
      work_off(x);
    } else {
      pump(never());
    }
  }
  phases_.pop_front();
  do_from_now_on(phase_name(phase));
}

void ComponentShell::phase_done(Phase phase, std::string failure) {
  if (phase_controller_)
    send(phase_controller_, PhaseDone{identity().number, phase, std::move(failure)});
}

void ComponentShell::fail(const std::string& what) {
  auto report = "failed in " + doing_ + ": " + shorten(what, longest_failure);
  // Whose configuration is wrong in the first life is named by who started the system.
  bool is_refused = in_configure_ && identity().incarnation == 1;
  log_runtime(is_refused ? LogLevel::debug : LogLevel::error, identity().full_name(), report);
  record_->fail(std::move(report));
  if (in_configure_)
    phase_done(Phase::configure, what);
}

bool ComponentShell::is_running() {
  file_arrived();
  return !stopping_;
}

std::string ComponentShell::do_from_now_on(std::string what) {
  // A crash in between is one of nobody knows what.
  crash_note_.set_doing({});
  auto before = std::exchange(doing_, std::move(what));
  crash_note_.set_doing(doing_);
  return before;
}

// -- work

void ComponentShell::file(caf::mailbox_element_ptr x) {
  auto& content = x->content();
  if (content.match_elements<ChangeNotice>()) {
    file_change(std::move(content.get_mutable_as<ChangeNotice>(0)));
  } else if (content.match_elements<ChangeNotices>()) {
    for (auto& notice : content.get_mutable_as<ChangeNotices>(0).notices)
      file_change(std::move(notice));
  } else if (content.match_elements<DeadlockProbe>()) {
    receive_probe(content.get_as<DeadlockProbe>(0));
  } else if (content.match_elements<NeighboursPtr>()) {
    meet(content.get_as<NeighboursPtr>(0));
  } else if (content.match_elements<EnterPhase>()) {
    auto& command = content.get_as<EnterPhase>(0);
    phase_controller_ = command.phase_controller;
    phases_.push_back(command.phase);
  } else if (content.match_elements<ComponentFault>()) {
    injected_faults_.take(content.get_as<ComponentFault>(0), Clock::now());
  } else if (content.match_elements<caf::exit_msg>()) {
    stopping_ = true;
  } else if (content.match_elements<caf::down_msg>()) {
    if (working_memory_ && content.get_as<caf::down_msg>(0).source == working_memory_.address())
      working_memory_lost_ = true;
    else if (manager_)
      work_.push_back(std::move(x)); // in its turn: after the last words of who has ended
    else
      connections_.forget(content.get_as<caf::down_msg>(0).source);
  } else if (content.match_elements<PushesTaken>()) {
    connections_.taken(x->sender, content.get_as<PushesTaken>(0));
  } else {
    work_.push_back(std::move(x));
  }
}

void ComponentShell::file_change(ChangeNotice notice) {
  auto heard = std::erase_if(notice.filters, [&](FilterId id) {
    auto listener = listeners_.find(id);
    if (listener == listeners_.end())
      return false;
    listener->second(*notice.event);
    return true;
  });
  if (heard > 0)
    return took_event(EventStream::runtime);
  if (!receiving_)
    return took_event(EventStream::component);
  ++record_->counters.events_received;
  if (queue_mode_ == EventQueue::newest) {
    auto i = std::find_if(work_.begin(), work_.end(),
                          [](auto& x) { return std::holds_alternative<ChangeNotice>(x); });
    if (i != work_.end()) {
      ++record_->counters.events_discarded;
      work_.erase(i);
      took_event(EventStream::component);
    }
  }
  work_.push_back(std::move(notice));
}

void ComponentShell::took_event(EventStream stream) {
  auto& receipts = stream == EventStream::runtime ? runtime_receipts_ : component_receipts_;
  if (auto count = receipts.take())
    send(working_memory_, EventsTaken{stream, count});
}

bool ComponentShell::deliver(Clock::time_point until, const std::function<bool()>& enough) {
  record_->leave_user_code();
  AtExit back_to_user_code{[this] { record_->enter_user_code(Clock::now()); }};
  for (;;) {
    file_arrived();
    if (stopping_)
      return false;
    injected_faults_.at_runtime();
    if (working_memory_lost_)
      throw WorkingMemoryLostException{
        {FailureKind::working_memory_lost,
         "the working memory of " + identity().subarchitecture + " has ended",
         {identity().subarchitecture, {}}}};
    if (work_.empty()) {
      record_->set_idle();
      if (!pump(until))
        return true;
      continue;
    }
    auto x = std::move(work_.front());
    work_.pop_front();
    work_off(x);
    if ((enough && enough()) || Clock::now() >= until)
      return true;
  }
}

void ComponentShell::respond(caf::mailbox_element& x, caf::message reply) {
  if (x.mid.is_request() && x.sender)
    x.sender->enqueue(ctrl(), x.mid.response_id(), std::move(reply), context());
}

void ComponentShell::begin_callback() {
  ++callbacks_;
  ++record_->counters.callbacks;
  injected_faults_.in_callback();
}

void ComponentShell::work_off(Work& x) {
  if (auto* notice = std::get_if<ChangeNotice>(&x))
    work_off_change(*notice);
  else if (auto* task = std::get_if<Task>(&x))
    user_code(task->what, task->run);
  else
    work_off_message(*std::get<caf::mailbox_element_ptr>(x));
}

void ComponentShell::work_off_message(caf::mailbox_element& x) {
  if (connections_.work_off(x))
    return;
  auto& content = x.content();
  if (managed_ && content.match_elements<TaskDecided>()) {
    auto& decided = content.get_as<TaskDecided>(0);
    user_code("task " + decided.id, [&] {
      injected_faults_.in_callback();
      managed_->decided(decided);
    });
  } else if (manager_ && content.match_elements<ProposeTask>()) {
    auto& proposal = content.get_as<ProposeTask>(0).proposal;
    auto& proposer = proposers_[proposal.id] = caf::actor_cast<caf::actor>(x.sender);
    if (watched_.insert(proposer.address()).second)
      monitor(proposer);
    user_code("the proposal of " + proposal.component, [&] { manager_->proposed(proposal); });
  } else if (manager_ && content.match_elements<RetractTask>()) {
    auto& id = content.get_as<RetractTask>(0).id;
    proposers_.erase(id);
    user_code("the retraction of " + id, [&] { manager_->retracted(id); });
  } else if (manager_ && content.match_elements<CompleteTask>()) {
    auto& done = content.get_as<CompleteTask>(0);
    proposers_.erase(done.id);
    user_code("the completion of " + done.id, [&] { manager_->completed(done.id, done.outcome); });
  } else if (manager_ && content.match_elements<caf::down_msg>()) {
    work_off_end(content.get_as<caf::down_msg>(0));
  }
}

void ComponentShell::work_off_change(const ChangeNotice& notice) {
  took_event(EventStream::component);
  // The receivers as they are now; a callback may remove any of them, or add some for later events.
  std::vector<std::pair<ReceiverId, std::shared_ptr<Receiver>>> called;
  for (auto id : notice.filters)
    if (auto i = receivers_.find(id); i != receivers_.end())
      called.emplace_back(id, i->second);
  std::sort(called.begin(), called.end(), [](auto& a, auto& b) {
    if (a.second->priority != b.second->priority)
      return a.second->priority > b.second->priority;
    return a.first < b.first;
  });
  for (auto& [id, receiver] : called) {
    if (stopping_)
      return;
    if (receivers_.count(id) == 0)
      continue;
    user_code("the callback for " + to_string(*notice.event), [&, &r = *receiver] {
      begin_callback();
      r.callback(*notice.event);
    });
  }
}

// -- operations

void ComponentShell::check_may_operate() const {
  if (working_memory_lost_ && !working_memory_)
    throw WorkingMemoryLostException{
      {FailureKind::working_memory_lost,
       "the working memory of " + identity().subarchitecture + " is not there",
       {identity().subarchitecture, {}}}};
  if (!working_memory_)
    throw std::logic_error(identity().full_name() + " is outside the subarchitectures and has no " +
                           "working memory");
  if (!started_)
    throw std::logic_error(
      "working memory is not there yet in configure(): use it from start() on");
  // Operations on an idle working memory never wait, so this is where a stop ends a loop of them.
  if (stopping_ && !in_stop_hook_)
    throw ComponentStopped{};
}

bool ComponentShell::is_in_another_process(const std::string& subarchitecture) const {
  if (!neighbours_)
    return false;
  auto i = neighbours_->working_memories.find(subarchitecture);
  return i != neighbours_->working_memories.end() &&
         dynamic_cast<caf::actor_proxy*>(caf::actor_cast<caf::abstract_actor*>(i->second));
}

Patience ComponentShell::patience(std::chrono::nanoseconds at_most) {
  return {client(), ++last_wait_, std::chrono::duration_cast<Timestamp>(at_most)};
}

std::optional<Failure>
ComponentShell::wait_until(const std::function<bool()>& done, Clock::time_point until,
                           const std::function<std::optional<WaitEdge>()>& wait) {
  // Long enough for most waits to end of themselves, short enough for a deadlock to be found within
  // a second.
  constexpr std::chrono::milliseconds between_probes{200};
  record_->leave_user_code();
  AtExit leave{[this] {
    waiting_.reset();
    deadlock_.clear();
    record_->enter_user_code(Clock::now());
  }};
  auto next_probe = Clock::now() + between_probes;
  file_arrived();
  while (!done()) {
    if (stopping_ && !in_stop_hook_)
      throw ComponentStopped{};
    injected_faults_.at_runtime();
    if (working_memory_lost_)
      return Failure{FailureKind::working_memory_lost,
                     "the working memory of " + identity().subarchitecture +
                       " ended before it answered",
                     {identity().subarchitecture, {}}};
    if (!deadlock_.empty())
      return Failure{FailureKind::deadlock,
                     identity().full_name() +
                       " gives up waiting, because it waits for itself: " + deadlock_,
                     waiting_->address};
    pump(wait ? std::min(until, next_probe) : until);
    // A stream of events wakes us again and again; the deadline holds all the same.
    auto time = Clock::now();
    if (!done() && time >= until)
      return Failure{FailureKind::no_answer, {}, {}};
    if (!wait || time < next_probe)
      continue;
    next_probe = time + between_probes;
    waiting_ = wait();
    // Finding that out may have been an operation of its own.
    record_->leave_user_code();
    if (waiting_)
      send(working_memory_, DeadlockProbe{{*waiting_}, 0});
  }
  return std::nullopt;
}

Outcome<caf::mailbox_element_ptr> ComponentShell::wait_for(std::uint64_t id, const Address& address,
                                                           std::chrono::nanoseconds patience,
                                                           const WaitEdge* wait) {
  bool answered = false;
  AtExit leave{[&] {
    close_slot(id);
    if (wait && !answered && !working_memory_lost_)
      send(working_memory_, CancelWait{wait->address, wait->waiter, wait->number});
  }};
  std::function<std::optional<WaitEdge>()> edge;
  if (wait)
    edge = [wait] { return std::optional{*wait}; };
  auto failure = wait_until([&] { return slot(id) != nullptr; }, Clock::now() + patience, edge);
  answered = slot(id) != nullptr;
  if (answered)
    return std::move(slot(id));
  if (failure->kind == FailureKind::no_answer)
    failure->message = identity().full_name() + " got no answer about " + to_string(address) +
                       " within " + detail::print_option(deadline()) +
                       ". Its --deadline can be raised";
  failure->address = address;
  return *failure;
}

void ComponentShell::receive_probe(DeadlockProbe probe) {
  if (!waiting_)
    return;
  switch (castor::receive_probe(probe, *waiting_)) {
    case ProbeVerdict::drop:
      break;
    case ProbeVerdict::pass_on:
      send(working_memory_, std::move(probe));
      break;
    case ProbeVerdict::deadlock:
      deadlock_ = cycle_of(probe);
      break;
  }
}

Outcome<Acknowledged> ComponentShell::try_unlock(const Address& address, LeaseToken token) {
  UnlockRequest request{address, client(), token};
  file_arrived();
  if (stopping_) {
    unit_->run([&] { send(working_memory_, request); });
    return Acknowledged{};
  }
  try {
    return finish<Acknowledged>(begin(request), address);
  } catch (const ComponentStopped&) {
    // The request is on its way.
    return Acknowledged{};
  }
}

Failure ComponentShell::unexpected_reply(const caf::type_erased_tuple& content,
                                         const Address& address) {
  std::string what = "it sent " + content.stringify();
  if (content.match_elements<caf::error>()) {
    auto& e = content.get_as<caf::error>(0);
    auto has_ended = e == caf::sec::request_receiver_down;
    what = has_ended ? "it has ended" : plain_words(e, system());
    // The news of that may still be on its way.
    if (has_ended && address.subarchitecture == identity().subarchitecture)
      working_memory_lost_ = true;
  }
  return {FailureKind::working_memory_lost, "no result from " + to_string(address) + ": " + what,
          address};
}

FilterId ComponentShell::subscribe(const ChangeFilter& filter, EventStream stream) {
  Subscribe request{++last_filter_, filter, stream};
  request.component = identity().name;
  // The option is about the component's own queue.
  if (stream == EventStream::component)
    request.queue_limit = queue_limit_;
  Address where{filter.subarchitecture.value_or(identity().subarchitecture), filter.id};
  value_or_throw(finish<Acknowledged>(begin(request), where));
  return request.id;
}

ReceiverId ComponentShell::add_receiver(const ChangeFilter& filter, ChangeCallback callback,
                                        Priority priority) {
  // Events may arrive before the answer does.
  auto id = last_filter_ + 1;
  receivers_[id] = std::make_shared<Receiver>(Receiver{std::move(callback), priority});
  try {
    return subscribe(filter, EventStream::component);
  } catch (const WorkingMemoryException&) {
    receivers_.erase(id);
    throw;
  }
}

void ComponentShell::call_in_turn(std::string what, std::function<void()> f) {
  work_.emplace_back(std::in_place_type<Task>, std::move(what), std::move(f));
}

void ComponentShell::add_listener(const ChangeFilter& filter, ChangeCallback f) {
  listeners_[last_filter_ + 1] = std::move(f);
  subscribe(filter, EventStream::runtime);
}

void ComponentShell::remove_receiver(ReceiverId id) {
  if (receivers_.erase(id) > 0)
    send(working_memory_, Unsubscribe{id});
}

std::unique_ptr<Calls> ComponentShell::make_calls(SubarchitectureComponent& component) {
  return std::make_unique<ComponentCalls>(component, *this);
}

// -- tasks

const caf::actor& ComponentShell::task_manager() const {
  return neighbours_->task_managers.at(identity().subarchitecture);
}

void ComponentShell::propose(const TaskProposal& task) {
  ++record_->counters.tasks_proposed;
  send(task_manager(), ProposeTask{task});
}

void ComponentShell::retract(const TaskId& id) {
  send(task_manager(), RetractTask{id});
}

void ComponentShell::complete(const TaskId& id, TaskOutcome outcome) {
  ++record_->counters.tasks_completed;
  send(task_manager(), CompleteTask{id, outcome});
}

void ComponentShell::decide(const TaskDecided& x) {
  auto i = proposers_.find(x.id);
  if (i == proposers_.end())
    return;
  send(i->second, x);
  if (x.decision == TaskDecision::rejected)
    proposers_.erase(i);
}

void ComponentShell::report(const TaskEvent& event) {
  if (services_->on_task)
    services_->on_task(event);
}

void ComponentShell::work_off_end(const caf::down_msg& x) {
  watched_.erase(x.source);
  std::vector<TaskId> left;
  for (auto& [id, proposer] : proposers_)
    if (proposer.address() == x.source)
      left.push_back(id);
  for (auto& id : left)
    proposers_.erase(id);
  user_code("the end of a component", [&] { manager_->abandoned(left, bool{x.reason}); });
}

} // namespace castor
