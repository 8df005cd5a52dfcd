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
#include "castor/wm/clock/clock_control.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

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
    /// Null for the real clock.
    ClockControl* clock = nullptr;
  };

  explicit RunLoop(const Parts& parts) : parts_(parts) {}

  /// False if it was interrupted. Throws SystemError if a configuration is wrong; then nothing was
  /// started.
  bool start();
  EndReason wait(const RunLimits& until);
  void stop();
  bool is_stopped() const { return stopped_; }

private:
  EndReason wait_for_real_time(const RunLimits& until);
  EndReason wait_for_simulated_time(const RunLimits& until);
  /// Waits for at most `glance_interval`. The reason to end, if there is one besides time and
  /// quiet. Asks all processes what their components do only if it has to, as that wakes them.
  std::optional<EndReason> look(bool asks_all);
  /// Names those for whom simulated time stands.
  void report_standing_time();
  void carry_out_orders();
  void refuse_orders();
  bool interrupted() const { return parts_.options.interrupted && parts_.options.interrupted(); }

  const Parts parts_;
  bool started_ = false;
  /// Its configuration was wrong, so it has never run.
  bool was_refused_ = false;
  bool stopped_ = false;
  /// Of the last look: when it was, what the components do, which simulated time it is, and since
  /// when.
  std::chrono::steady_clock::time_point looked_at_{};
  std::vector<ComponentStatus> components_;
  Timestamp seen_time_{0};
  std::chrono::steady_clock::time_point seen_since_{};
  /// CPU time of each component when simulated time was last seen to go on.
  std::map<std::string, std::chrono::nanoseconds> cpu_then_;
};

} // namespace castor
