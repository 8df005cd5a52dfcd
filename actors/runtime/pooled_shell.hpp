#pragma once

#include "castor/actors/runtime/component_pool.hpp"
#include "castor/actors/runtime/running_components.hpp"
#include "castor/actors/runtime/shell.hpp"
#include "castor/wm/clock/simulated_clock.hpp"

#include <cstdint>
#include <functional>
#include <optional>

namespace castor {

/// The actor around a CallbackComponent, which has no thread: a ComponentPool runs its turns, which
/// do not wait.
///
/// An event is delivered once the results of all operations that earlier callbacks began were
/// called back, as if these had waited for them; so no more operations are open than one callback
/// begins. A turn delivers what has arrived, but lasts for no longer than `longest_turn` plus the
/// last callback.
class PooledShell final : public ComponentShell, public PoolMember {
public:
  PooledShell(caf::actor_config& config, ShellParts parts)
    : ComponentShell(config, std::move(parts), ActorThread::shared) {}

  void launch(caf::execution_unit* unit, bool lazy, bool hide) override;
  void run_turn() override;
  caf::strong_actor_ptr handle() override { return caf::strong_actor_ptr{ctrl()}; }

  /// Throws std::logic_error: it does not wait.
  bool deliver(std::optional<std::chrono::nanoseconds> duration,
               const std::function<bool()>& enough) override;

private:
  enum class Stage : std::uint8_t {
    /// In the phases, or on the way to the next one.
    living,
    /// start() was called; the results of its operations have not all been called back.
    starting,
    /// stop() was called; the results of its operations have not all been called back.
    leaving,
    ended,
  };

  void arrived() override { services_->pool->schedule(*this); }

  /// Lives, or leaves; true if there is more to do at once.
  bool work();
  /// One piece of the component's life; false if there is none.
  bool live_on();
  /// Enters the next phase if that is due.
  bool enter_phase();
  bool work_in_phase();
  /// Calls back the result of the next operation.
  void call_back();
  /// The rest of the component's life, after the stop hook.
  void leave();
  void end();
  /// Has this actor woken when timers, commands and deadlines are due.
  void set_alarms();
  void set_alarm(Clock::time_point time);
  void set_simulated_alarm(Clock::time_point time);

  static constexpr auto no_alarm = Clock::time_point::max();

  Stage stage_ = Stage::living;
  std::optional<RunningComponent> running_;
  /// When the pool wakes this actor, at the latest.
  Clock::time_point alarm_ = no_alarm;
  /// The same for the simulated clock.
  Clock::time_point simulated_alarm_ = no_alarm;
  std::optional<SimulatedClock::Key> simulated_key_;
};

} // namespace castor
