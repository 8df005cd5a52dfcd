#pragma once

#include "castor/actors/runtime/neighbours.hpp"
#include "castor/actors/runtime/record.hpp"
#include "castor/actors/runtime/services.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace castor {

/// Data on a component and the system around it, shared by the parts of the component's runtime.
/// Used on the component's own thread only.
class ComponentContext {
public:
  using Clock = std::chrono::steady_clock;
  using NeighboursObserver = std::function<void(const Neighbours& before)>;

  ComponentContext(ComponentRecord& record, ComponentServices& services,
                   std::chrono::milliseconds deadline, std::uint32_t push_limit)
    : record_(record), services_(services), deadline_(deadline), push_limit_(push_limit) {}

  const ComponentIdentity& identity() const { return record_.identity(); }
  ComponentRecord& record() { return record_; }
  ComponentCounters& counters() { return record_.counters; }
  HeldLeases& leases() { return record_.leases; }
  const ClientPtr& client() const { return record_.client(); }
  ComponentServices& services() { return services_; }

  /// Time since the start of the system, simulated if its clock is.
  Timestamp now() const {
    if (services_.clock)
      return services_.clock->now();
    return std::chrono::duration_cast<Timestamp>(Clock::now() - services_.epoch);
  }

  /// The same as a point of time; `since_start` is its inverse.
  Clock::time_point time_point() const {
    return services_.clock ? services_.epoch + services_.clock->now() : Clock::now();
  }
  Timestamp since_start(Clock::time_point x) const {
    return std::chrono::ceil<Timestamp>(x - services_.epoch);
  }

  /// How long operations may take.
  std::chrono::milliseconds deadline() const { return deadline_; }

  /// Most pushes of one type that may wait for the component.
  std::uint32_t push_limit() const { return push_limit_; }

  // -- the others in the system

  const Neighbours& neighbours() const { return *neighbours_; }

  /// Calls the observers, unless these are the first.
  void set_neighbours(NeighboursPtr neighbours);
  /// Calls `f` whenever the neighbours have changed.
  void on_neighbours(NeighboursObserver f) { observers_.push_back(std::move(f)); }

  /// Null for a component outside the subarchitectures, and while the working memory is down.
  const WorkingMemoryActor& working_memory() const { return working_memory_; }
  void set_working_memory(WorkingMemoryActor x) { working_memory_ = std::move(x); }

  /// Whether the working memory of that subarchitecture is one of another process.
  bool is_in_another_process(const std::string& subarchitecture) const;

  /// Drops the handles of other actors: two actors that hold each other would live for ever.
  void forget_neighbours() { neighbours_ = nullptr; }

private:
  ComponentRecord& record_;
  ComponentServices& services_;
  const std::chrono::milliseconds deadline_;
  const std::uint32_t push_limit_;
  NeighboursPtr neighbours_;
  WorkingMemoryActor working_memory_;
  std::vector<NeighboursObserver> observers_;
};

} // namespace castor
