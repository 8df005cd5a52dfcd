#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/actors/component/calls.hpp"
#include "castor/actors/component/commands.hpp"
#include "castor/actors/component/component_identity.hpp"
#include "castor/actors/component/connections.hpp"
#include "castor/actors/component/operations.hpp"
#include "castor/actors/component/task_link.hpp"
#include "castor/actors/component/timer_id.hpp"
#include "castor/wm/clock/activity.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace castor {

class SubarchitectureComponent;

/// Interface of the runtime for one component. Used on the component's own thread only, except for
/// the first four functions.
class ComponentRuntime {
public:
  virtual ~ComponentRuntime() = default;

  virtual const ComponentIdentity& identity() const = 0;
  /// Whether the calling thread is the one that runs the component.
  virtual bool is_own_thread() const = 0;
  /// Time since the start of the system, simulated if its clock is.
  virtual Timestamp now() const = 0;
  /// Keeps simulated time from going on as long as the result lives; nothing if the clock is real.
  virtual TimeHold hold_time() const = 0;

  /// A function for any thread by which the component looks again at what it waits for.
  virtual std::function<void()> waker() = 0;

  /// False from the moment the component was told to stop.
  virtual bool is_running() = 0;

  /// Delivers what arrives for `duration`, without limit if there is no value, or until `enough`
  /// (may be empty) returns true after a delivery; false if the component was told to stop.
  virtual bool deliver(std::optional<std::chrono::nanoseconds> duration,
                       const std::function<bool()>& enough) = 0;

  virtual TimerId add_timer(std::chrono::nanoseconds period, std::function<void()> call) = 0;
  virtual void remove_timer(TimerId id) = 0;

  /// Number of change callbacks that were called so far.
  virtual std::uint64_t callbacks() const = 0;

  /// Unique number of this run, part of the ids that components make, if entries outlive the
  /// system; otherwise 0.
  virtual std::uint64_t run() const = 0;

  virtual void end_system(int status, const std::string& reason) = 0;

  virtual Operations& operations() = 0;
  virtual Connections& connections() = 0;
  virtual Commands& commands() = 0;
  virtual TaskLink& tasks() = 0;
  virtual std::unique_ptr<Calls> make_calls(SubarchitectureComponent& component) = 0;
  virtual std::unique_ptr<Actions> make_actions(SubarchitectureComponent& component) = 0;
};

} // namespace castor
