#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/link/private_folder.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/cli/child_processes.hpp"
#include "castor/tools/cli/signals.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace castor::cli {

/// A node that is to run on this machine, in a process of its own.
struct LocalNode {
  std::string name;
  /// MB that it may allocate; 0 for as much as there is.
  std::int64_t memory_limit = 0;
};

/// Nodes on this machine: they stand in for those of other machines, or keep a component apart from
/// the others. They listen at Unix sockets that only their user reaches. One that dies is started
/// again where it listened, and if that fails, again every second. They end with this object, and
/// also if this process is killed.
class LocalNodes {
public:
  /// Starts these nodes, by host. Throws std::runtime_error if one does not come up.
  LocalNodes(const std::map<std::string, LocalNode>& nodes, std::vector<std::string> plugins,
             std::string tls);
  LocalNodes(const LocalNodes&) = delete;
  LocalNodes& operator=(const LocalNodes&) = delete;
  ~LocalNodes();

  /// Where they listen, by host.
  std::map<std::string, Endpoint> endpoints() const;

  /// Calls a function with the number of a host's process, which is not that of another one
  /// meanwhile; false if it has none.
  bool with_process(const std::string& host, const std::function<void(pid_t)>& f) const;

  /// Kills the process of a host, with all that it has started, if it was started before this
  /// moment; false if there is none such.
  bool kill_older(const std::string& host, std::chrono::steady_clock::time_point than);

  /// Processes that end from now on are not started again.
  void end_restarts();

  /// The processes that there are now, by host.
  std::map<std::string, pid_t> processes() const;

private:
  struct Process {
    LocalNode node;
    pid_t id = -1;
    std::chrono::steady_clock::time_point started{};
    /// Its standard input, and what tells of its end.
    int input = -1;
    int end = -1;
    Endpoint at;
    /// Whether it could not be started when that was last tried.
    bool failed = false;
  };

  /// Throws std::runtime_error.
  void start(Process& x) const;
  void watch();
  /// Of a process that has ended.
  void take_leave(const std::string& host);
  /// Starts one in its place.
  void restart(const std::string& host);

  /// Where they listen, at Unix sockets.
  RunFolder folder_;
  const std::vector<std::string> plugins_;
  const std::string tls_;
  mutable std::mutex mutex_;
  std::map<std::string, Process> processes_;
  bool ending_ = false;
  bool restarts_ = true;
  /// Written to when the watch is over.
  int wake_[2] = {-1, -1};
  AtForcedEnd at_forced_end_{kill_children};
  std::thread watch_;
};

/// The host that an isolated component is for itself.
std::string isolated_host(const std::string& component);

/// Starts nodes on this machine for the isolated components of the architecture, and, if wanted,
/// for all other hosts that it names; the options say where they are. Null if none is needed.
/// Throws std::invalid_argument, if a component is to be isolated on another machine, and
/// std::runtime_error.
std::unique_ptr<LocalNodes> start_local_nodes(ArchitectureDescription& architecture,
                                              bool for_all_hosts,
                                              const std::vector<std::string>& plugins,
                                              const std::string& tls, SystemOptions& options);

} // namespace castor::cli
