#pragma once

#include "castor/actors/node/processes.hpp"
#include "castor/actors/system/fault_port.hpp"
#include "castor/actors/system/roster_feed.hpp"
#include "castor/actors/system/supervisor_client.hpp"

#include <caf/actor_system.hpp>

#include <string>

namespace castor {

/// Sends faults to their targets. Safe to use from any thread.
class SystemFaults : public FaultPort {
public:
  /// All of them have to outlive it. `listener` is sent FaultHappened when a fault with a number
  /// takes effect.
  SystemFaults(caf::actor_system& system, const Processes& processes, const RosterFeed& roster,
               const SupervisorClient& supervisor, const caf::actor& listener)
    : system_(system), processes_(processes), roster_(roster), supervisor_(supervisor),
      listener_(listener) {}

  bool inject(const std::string& component, const ComponentFault& x) override;
  void inject(ProcessNumber a, ProcessNumber b, const LinkFault& x) override;
  bool inject(const std::string& subarchitecture, const JournalFault& x) override;
  bool jump_clock(const std::string& subarchitecture, Timestamp by) override;

private:
  template <class InjectedFault>
  InjectedFault observed(InjectedFault x) const;
  template <class WorkingMemoryFault>
  bool inject_into_working_memory(const std::string& subarchitecture, const WorkingMemoryFault& x);

  caf::actor_system& system_;
  const Processes& processes_;
  const RosterFeed& roster_;
  const SupervisorClient& supervisor_;
  const caf::actor& listener_;
};

} // namespace castor
