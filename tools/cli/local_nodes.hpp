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

/// A node on this machine, in a process of its own.
struct LocalNode {
  std::string name;
  /// MB that it may allocate; 0 for no limit.
  std::int64_t memory_limit = 0;
};

/// Node processes on this machine, in place of nodes on other machines or to isolate a component.
/// They listen at Unix sockets that only their user can open. A node that ends is restarted at the
/// same socket; if that fails, every second. They end with this object, and also if this process is
/// killed.
class LocalNodes {
public:
  /// Starts these nodes, given by host. Throws std::runtime_error if one does not start.
  LocalNodes(const std::map<std::string, LocalNode>& nodes, std::vector<std::string> plugins,
             std::string tls);
  LocalNodes(const LocalNodes&) = delete;
  LocalNodes& operator=(const LocalNodes&) = delete;
  ~LocalNodes();

  /// Addresses at which the nodes listen, by host.
  std::map<std::string, Endpoint> endpoints() const;

  /// Calls a function with the id of a host's process; the id is not reused during the call. False
  /// if the host has no process.
  bool with_process(const std::string& host, const std::function<void(pid_t)>& f) const;

  /// Kills the process of a host and its descendants if it was started before this time; false if
  /// there is no such process.
  bool kill_older(const std::string& host, std::chrono::steady_clock::time_point than);

  /// Does not restart processes that end from now on.
  void end_restarts();

  /// Ids of the running processes, by host.
  std::map<std::string, pid_t> processes() const;

private:
  struct Process {
    LocalNode node;
    pid_t id = -1;
    std::chrono::steady_clock::time_point started{};
    /// Its standard input, and a pipe that is closed at its end.
    int input = -1;
    int end = -1;
    Endpoint at;
    /// Whether the last attempt to start it failed.
    bool failed = false;
  };

  /// Throws std::runtime_error.
  void start(Process& x) const;
  void watch();
  /// Handles the end of a host's process.
  void handle_exit(const std::string& host);
  /// Starts a new process for a host.
  void restart(const std::string& host);

  /// Folder of their Unix sockets.
  RunFolder folder_;
  const std::vector<std::string> plugins_;
  const std::string tls_;
  mutable std::mutex mutex_;
  std::map<std::string, Process> processes_;
  bool ending_ = false;
  bool restarts_ = true;
  /// Pipe to wake the watching thread, written to when it has to end.
  int wake_[2] = {-1, -1};
  AtForcedEnd at_forced_end_{kill_children};
  std::thread watch_;
};

/// Name of the host of an isolated component.
std::string isolated_host(const std::string& component);

/// Starts nodes on this machine for the isolated components of the architecture and, if
/// `for_all_hosts`, for all other hosts that it names; adds their addresses to `options`. Null if
/// none is needed. Throws std::invalid_argument if a component is to be isolated on another
/// machine, and std::runtime_error if a node does not start.
std::unique_ptr<LocalNodes> start_local_nodes(ArchitectureDescription& architecture,
                                              bool for_all_hosts,
                                              const std::vector<std::string>& plugins,
                                              const std::string& tls, SystemOptions& options);

} // namespace castor::cli
