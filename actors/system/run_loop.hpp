#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/system/observation.hpp"
#include "castor/actors/system/reconfiguration.hpp"
#include "castor/actors/system/run_limits.hpp"
#include "castor/actors/system/status_collector.hpp"
#include "castor/actors/system/supervisor_client.hpp"
#include "castor/actors/system/system_inbox.hpp"

namespace castor {

/// The main thread of a system: starts it, carries out requests of other threads while it runs, and
/// stops it.
class RunLoop {
public:
  /// All of them have to outlive the loop.
  struct Parts {
    const SystemOptions& options;
    const ArchitectureDescription& architecture;
    Processes& processes;
    SupervisorClient& supervisor;
    StatusCollector& status;
    Observation& observation;
    Reconfiguration& reconfiguration;
    SystemInbox& inbox;
  };

  explicit RunLoop(const Parts& parts) : parts_(parts) {}

  /// False if it was interrupted. Throws SystemError if a configuration is wrong; then nothing was
  /// started.
  bool start();
  EndReason wait(const RunLimits& until);
  void stop();
  bool is_stopped() const { return stopped_; }

private:
  void carry_out_orders();
  void refuse_orders();
  bool interrupted() const { return parts_.options.interrupted && parts_.options.interrupted(); }

  const Parts parts_;
  bool started_ = false;
  /// Its configuration was wrong, so it has never run.
  bool was_refused_ = false;
  bool stopped_ = false;
};

} // namespace castor
