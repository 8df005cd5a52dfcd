#pragma once

#include "castor/actors/component/component.hpp"
#include "castor/actors/component/component_runtime.hpp"
#include "castor/actors/runtime/change_receivers.hpp"
#include "castor/actors/runtime/component_commands.hpp"
#include "castor/actors/runtime/component_connections.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/component_operations.hpp"
#include "castor/actors/runtime/component_tasks.hpp"
#include "castor/actors/runtime/inbox.hpp"
#include "castor/actors/runtime/injected_faults.hpp"
#include "castor/actors/runtime/life_cycle.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/open_operations.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/actors/runtime/provider_client.hpp"
#include "castor/actors/runtime/services.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/runtime/timers.hpp"
#include "castor/actors/runtime/user_code.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace castor {

class RunningComponent;

/// Parameters of a component's shell.
struct ShellParts {
  std::unique_ptr<Component> component;
  std::shared_ptr<ComponentRecord> record;
  std::shared_ptr<ComponentServices> services;
  /// Owned by `services`.
  CallerRuns* unit = nullptr;
  /// Its line in the `.cast` file, "vision.cast:7"; may be empty.
  std::string where = {};
};

/// The actor around a component: runs its life cycle, and passes messages to the parts that handle
/// them. Before the component enters its first phase it must be sent its neighbours.
class ComponentShell : public PumpedActor, public ComponentRuntime {
public:
  using Clock = PumpedActor::Clock;

  ComponentShell(caf::actor_config& config, ShellParts parts)
    : ComponentShell(config, std::move(parts), ActorThread::own) {}

  const char* name() const override { return "component"; }

  // -- for the component

  const ComponentIdentity& identity() const override { return record_->identity(); }
  bool is_own_thread() const override {
    return std::this_thread::get_id() == thread_.load(std::memory_order_relaxed);
  }
  Timestamp now() const override { return context_.now(); }
  bool is_running() override { return client_.is_running(); }
  TimeHold hold_time() const override {
    return services_->clock ? services_->clock->hold() : TimeHold{};
  }
  std::function<void()> waker() override;
  bool deliver(std::optional<std::chrono::nanoseconds> duration,
               const std::function<bool()>& enough) override;
  TimerId add_timer(std::chrono::nanoseconds period, std::function<void()> call) override {
    return timers_.add(period, context_.time_point(), std::move(call));
  }
  void remove_timer(TimerId id) override { timers_.remove(id); }
  std::uint64_t callbacks() const override { return code_.callbacks(); }
  std::uint64_t run() const override { return services_->run.load(); }
  void end_system(int status, const std::string& reason) override {
    services_->end_system(status, reason);
  }
  Operations& operations() override { return operations_; }
  Connections& connections() override { return connections_; }
  Commands& commands() override { return commands_; }
  TaskLink& tasks() override { return tasks_; }
  std::unique_ptr<Calls> make_calls(SubarchitectureComponent& component) override;
  std::unique_ptr<Actions> make_actions(SubarchitectureComponent& component) override;

protected:
  ComponentShell(caf::actor_config& config, ShellParts parts, ActorThread thread);

  // -- life

  /// Calls `f`, which is a part of the component's life. An exception ends that: it is the
  /// component's failure, unless it is the normal end. False if there was one.
  bool live(const std::function<void()>& f);
  /// Code of a component that has ended; an exception is its failure.
  void run_last_code(const std::function<void()>& f);
  /// Takes the safe states, and calls stop() if that is due.
  void run_stop_hook();
  /// The component's end, after the stop hook.
  void end_component(RunningComponent& running);

  void configure_component();
  void start_component();
  void run_component();
  /// Delivers work, if the component has started, until the next phase is due.
  void await_phase(Phase phase);
  void phase_done(Phase phase, std::string failure);
  void fail(const std::string& what);

  // -- work

  /// Throws what ends the component if its working memory has ended.
  void check_working_memory() const;
  void run_timers();
  void handle_next();

  std::unique_ptr<Component> component_;
  std::shared_ptr<ComponentRecord> record_;
  std::shared_ptr<ComponentServices> services_;
  CallerRuns* unit_;
  std::atomic<std::thread::id> thread_{};

private:
  struct EventQueueOptions {
    EventQueue mode = EventQueue::all;
    std::uint32_t limit = standard_queue_limit;
  };
  static EventQueueOptions event_queue_of(const Component& component);

  void act() override;
  void live_on_thread();
  /// Drops all handles of other actors: two actors that hold each other would live for ever.
  void forget_actors();

  // -- what arrives

  void file(caf::mailbox_element_ptr x) override;
  void file_down(caf::mailbox_element_ptr x);
  void file_change(ChangeNotice notice);
  void set_neighbours(NeighboursPtr neighbours);
  void acknowledge(const std::optional<EventsTaken>& x);

  // -- work

  /// Delivers until that point of the system's time.
  bool deliver_until(Clock::time_point until, const std::function<bool()>& enough);
  /// Files what arrives, or returns at `until`, of the system's time, or earlier if commands or
  /// timers are due; false once `until` has passed without any.
  bool wait_for_work(Clock::time_point until);
  void handle(Inbox::Work& x);
  void handle_change(const ChangeNotice& notice);

  /// Actor that the end of a phase is reported to, or null.
  caf::actor phase_controller_;
  const EventQueueOptions event_queue_;

protected:
  ComponentContext context_;
  LifeCycle life_;
  InjectedFaults faults_;
  UserCode code_;
  ChangeReceivers receivers_;
  Inbox inbox_;
  OperationsClient client_;
  /// Only of a component without a thread.
  OpenOperations open_;
  ComponentOperations operations_;
  ProviderClient providers_;
  ComponentConnections connections_;
  ComponentCommands commands_;
  ComponentTasks tasks_;
  Timers timers_;
};

} // namespace castor
