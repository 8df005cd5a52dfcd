#pragma once

#include "castor/actors/component/component.hpp"
#include "castor/actors/component/component_runtime.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/runtime/component_connections.hpp"
#include "castor/actors/runtime/component_operations.hpp"
#include "castor/actors/runtime/crash_report.hpp"
#include "castor/actors/runtime/injected_faults.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/neighbours.hpp"
#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/runtime/services.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/wm/events/event_flow.hpp"
#include "castor/wm/events/receipts.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace castor {

class ManagedComponent;
class TaskManager;

/// What a component's shell is made of.
struct ShellParts {
  std::unique_ptr<Component> component;
  std::shared_ptr<ComponentRecord> record;
  std::shared_ptr<ComponentServices> services;
  /// Owned by `services`.
  CallerRuns* unit = nullptr;
  /// Its line in the `.cast` file, "vision.cast:7"; may be empty.
  std::string where = {};
};

/// The actor around a component: leads it through its life, delivers what arrives, and carries out
/// its operations. Before it enters its first phase it must be sent its neighbours.
class ComponentShell : public PumpedActor, public ComponentRuntime, private TaskLink {
public:
  using Clock = ComponentRuntime::Clock;

  ComponentShell(caf::actor_config& config, ShellParts parts);

  const char* name() const override { return "component"; }

  /// Whether the calling thread is the one that runs the component.
  bool is_own_thread() const override { return std::this_thread::get_id() == thread_; }

  // -- for the component, on its own thread

  const ComponentIdentity& identity() const override { return record_->identity(); }
  ComponentServices& services() { return *services_; }
  const Neighbours& neighbours() const { return *neighbours_; }
  ComponentCounters& counters() { return record_->counters; }

  bool is_running() override;

  /// Delivers work until `until`, or until `enough` says so after a piece of work; false if the
  /// component was told to stop.
  bool deliver(Clock::time_point until, const std::function<bool()>& enough) override;

  /// How many change callbacks were called so far.
  std::uint64_t callbacks() const override { return callbacks_; }

  const ClientPtr& client() const { return record_->client(); }
  HeldLeases& leases() { return record_->leases; }

  /// How long operations may take.
  std::chrono::milliseconds deadline() const { return component_->deadline_.get(); }

  /// How many pushes of one type may wait for the component.
  std::uint32_t push_limit() const { return component_->push_limit_; }

  /// For an operation that may have to wait for a lease to end.
  Patience patience(std::chrono::nanoseconds at_most);

  /// Whether the working memory of that subarchitecture is one of another process.
  bool is_in_another_process(const std::string& subarchitecture) const;

  /// Sends an operation to the own working memory; its outcome is taken with `finish`, once.
  template <class Request>
  std::uint64_t begin(const Request& request) {
    check_may_operate();
    std::optional<OperationRecorder::Open> open;
    if (recorder_)
      open = recorder_->begin(request);
    std::uint64_t id = 0;
    unit_->run(
      [&] { id = this->request(working_memory_, caf::infinite, request).id().integer_value(); });
    open_slot(id);
    if (open)
      recorder_->sent(id, *std::move(open));
    return id;
  }

  template <class Reply>
  Outcome<Reply> finish(std::uint64_t id, const Address& address) {
    return finish<Reply>(id, address, deadline(), nullptr);
  }

  /// Of an operation that may have to wait for a lease to end; `wait` says what for.
  template <class Reply>
  Outcome<Reply> finish_wait(std::uint64_t id, WaitEdge wait, const Patience& patience) {
    // The working memory knows better why it took too long, so it is let to say so first.
    constexpr std::chrono::seconds grace{1};
    wait.waiter = client();
    wait.number = patience.number;
    wait.since = now();
    return finish<Reply>(id, wait.address, patience.at_most + grace, &wait);
  }

  /// Calls `done` after every message that arrives until it says true. Nothing if all went well.
  std::optional<Failure> wait_until(const std::function<bool()>& done, Clock::time_point until,
                                    const std::function<std::optional<WaitEdge>()>& wait);

  /// Since the system began.
  Timestamp now() const override {
    return std::chrono::duration_cast<Timestamp>(Clock::now() - services_->epoch);
  }

  /// Gives a lease back. While the component stops, without waiting for the answer.
  Outcome<Acknowledged> try_unlock(const Address& address, LeaseToken token);

  /// Calls `f` as soon as an event that the filter wants arrives, in the middle of whatever the
  /// component does: only for the runtime's own bookkeeping.
  void add_listener(const ChangeFilter& filter, ChangeCallback f);
  /// Calls `f` as soon as the component's neighbours are others, with those before; as for
  /// listeners, only for the runtime's own bookkeeping.
  void on_neighbours(std::function<void(const Neighbours& before)> f) {
    on_neighbours_ = std::move(f);
  }
  /// Calls `f` when the component has worked off all that has arrived so far. `what` is what the
  /// component then does, for the report if that fails.
  void call_in_turn(std::string what, std::function<void()> f);
  void abandon(std::uint64_t id) { close_slot(id); }

  ReceiverId add_receiver(const ChangeFilter& filter, ChangeCallback callback, Priority priority);
  void remove_receiver(ReceiverId id);
  std::size_t receiver_count() const { return receivers_.size(); }
  void receive_changes(bool on) { receiving_ = on; }

  std::uint64_t run() const override { return services_->run.load(); }
  void end_system(int status, const std::string& reason) override {
    services_->end_system(status, reason);
  }
  Operations& operations() override { return operations_; }
  Connections& connections() override { return connections_; }
  TaskLink& tasks() override { return *this; }
  std::unique_ptr<Calls> make_calls(SubarchitectureComponent& component) override;

private:
  friend class ComponentConnections;

  struct Receiver {
    ChangeCallback callback;
    Priority priority;
  };

  /// Something that the runtime does in the component's name.
  struct Task {
    std::string what;
    std::function<void()> run;
  };

  /// Something to be done when there is time: an event to deliver, another message to answer, or
  /// a task.
  using Work = std::variant<ChangeNotice, caf::mailbox_element_ptr, Task>;

  void act() override;
  void file(caf::mailbox_element_ptr x) override;
  void file_change(ChangeNotice notice);
  /// One more is delivered or dropped, for which the working memory may send another.
  void took_event(EventStream stream);

  // -- life
  void live();
  /// Delivers work, if the component has started, until the next phase is due.
  void await_phase(Phase phase);
  void meet(NeighboursPtr neighbours);
  void phase_done(Phase phase, std::string failure);
  /// Gives up all handles of other actors: two that hold each other would live for ever.
  void let_go();
  void fail(const std::string& what);

  // -- work
  void work_off(Work& x);
  void work_off_message(caf::mailbox_element& x);
  void work_off_change(const ChangeNotice& notice);
  void work_off_end(const caf::down_msg& x);
  /// To be called in the component's own code, where a callback begins.
  void begin_callback();
  template <class F>
  void user_code(const std::string& what, F&& f) {
    // After an exception `doing_` stays at the innermost call, for the report.
    auto outer = do_from_now_on(what);
    record_->enter_user_code(Clock::now());
    f();
    record_->leave_user_code();
    do_from_now_on(std::move(outer));
  }
  /// Returns what was done before.
  std::string do_from_now_on(std::string what);
  void respond(caf::mailbox_element& x, caf::message reply);

  // -- operations
  void check_may_operate() const;
  template <class Reply>
  Outcome<Reply> finish(std::uint64_t id, const Address& address, std::chrono::nanoseconds patience,
                        const WaitEdge* wait) {
    auto content = wait_for(id, address, patience, wait);
    if (!content)
      return content.failure();
    auto result = take<Outcome<Reply>>(**content, address);
    if (recorder_)
      recorder_->end(id, result);
    return result;
  }

  Outcome<caf::mailbox_element_ptr> wait_for(std::uint64_t id, const Address& address,
                                             std::chrono::nanoseconds patience,
                                             const WaitEdge* wait);
  FilterId subscribe(const ChangeFilter& filter, EventStream stream);
  void receive_probe(DeadlockProbe probe);

  template <class Result>
  Result take(caf::mailbox_element& x, const Address& address) {
    auto& content = x.content();
    if (content.match_elements<Result>())
      return content.get_as<Result>(0);
    return unexpected_reply(content, address);
  }

  Failure unexpected_reply(const caf::type_erased_tuple& content, const Address& address);

  // -- tasks
  const caf::actor& task_manager() const;
  void propose(const TaskProposal& task) override;
  void retract(const TaskId& id) override;
  void complete(const TaskId& id, TaskOutcome outcome) override;
  void decide(const TaskDecided& x) override;
  void report(const TaskEvent& event) override;

  std::unique_ptr<Component> component_;
  ManagedComponent* managed_ = nullptr;
  TaskManager* manager_ = nullptr;
  std::shared_ptr<ComponentRecord> record_;
  std::shared_ptr<ComponentServices> services_;
  CallerRuns* unit_;
  std::thread::id thread_;
  NeighboursPtr neighbours_;
  /// Null for a component outside the subarchitectures.
  WorkingMemoryActor working_memory_;

  /// What arrived, oldest first.
  std::deque<Work> work_;
  std::deque<Phase> phases_;
  caf::actor phase_controller_;
  bool stopping_ = false;
  bool in_stop_hook_ = false;
  bool working_memory_lost_ = false;
  bool started_ = false;
  bool receiving_ = true;
  EventQueue queue_mode_ = EventQueue::all;
  std::uint32_t queue_limit_ = standard_queue_limit;
  Receipts component_receipts_{standard_queue_limit};
  Receipts runtime_receipts_{standard_queue_limit};
  /// What the component's own code is being called for, for the report if it throws.
  std::string doing_;
  /// The same, for the report of a crash.
  CrashNote crash_note_;
  bool in_configure_ = false;
  std::uint64_t callbacks_ = 0;

  /// If operations are to be written down.
  std::optional<OperationRecorder> recorder_;
  std::map<ReceiverId, std::shared_ptr<Receiver>> receivers_;
  std::map<FilterId, ChangeCallback> listeners_;
  std::function<void(const Neighbours& before)> on_neighbours_;
  FilterId last_filter_ = 0;

  WaitNumber last_wait_ = 0;
  /// What the component waits for now, if that could be a cycle.
  std::optional<WaitEdge> waiting_;
  /// The cycle that its wait has to be given up for; empty for none.
  std::string deadlock_;

  InjectedFaults injected_faults_;
  ComponentOperations operations_{*this};
  ComponentConnections connections_{*this};
  std::map<TaskId, caf::actor> proposers_;
  /// Components whose end this task manager will be told.
  std::set<caf::actor_addr> watched_;
};

} // namespace castor
