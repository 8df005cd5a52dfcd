#pragma once

#include "castor/actors/component/calls.hpp"
#include "castor/actors/component/component_identity.hpp"
#include "castor/actors/component/connections.hpp"
#include "castor/actors/component/operations.hpp"
#include "castor/actors/component/task_link.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace castor {

class SubarchitectureComponent;

/// What a component has of the runtime around it. To be used on the component's own thread, except
/// for the first three.
class ComponentRuntime {
public:
  using Clock = std::chrono::steady_clock;

  virtual ~ComponentRuntime() = default;

  virtual const ComponentIdentity& identity() const = 0;
  /// Whether the calling thread is the one that runs the component.
  virtual bool is_own_thread() const = 0;
  /// Since the system began.
  virtual Timestamp now() const = 0;

  /// False from the moment the component was told to stop.
  virtual bool is_running() = 0;

  /// Delivers what arrives until then, or until `enough`, which may be empty, says so after a piece
  /// of work; false if the component was told to stop.
  virtual bool deliver(Clock::time_point until, const std::function<bool()>& enough) = 0;

  /// Number of change callbacks that were called so far.
  virtual std::uint64_t callbacks() const = 0;

  /// Part of the ids that components make, where entries outlive the system: nobody else's number.
  /// 0 where they do not.
  virtual std::uint64_t run() const = 0;

  virtual void end_system(int status, const std::string& reason) = 0;

  virtual Operations& operations() = 0;
  virtual Connections& connections() = 0;
  virtual TaskLink& tasks() = 0;
  virtual std::unique_ptr<Calls> make_calls(SubarchitectureComponent& component) = 0;
};

} // namespace castor
