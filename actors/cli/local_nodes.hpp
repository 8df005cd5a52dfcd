#pragma once

#include "castor/actors/link/dial.hpp"

#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

namespace castor::cli {

/// Nodes on this machine that stand in for those of other machines, each in a process of its own.
/// They end with this object, and also if this process is killed.
class LocalNodes {
public:
  /// Starts nodes of these names, by host. Throws std::runtime_error if one does not come up.
  LocalNodes(const std::map<std::string, std::string>& names,
             const std::vector<std::string>& plugins, const std::string& tls);
  LocalNodes(const LocalNodes&) = delete;
  LocalNodes& operator=(const LocalNodes&) = delete;
  ~LocalNodes();

  /// Where they listen, by host.
  const std::map<std::string, Endpoint>& endpoints() const { return endpoints_; }

private:
  struct Process {
    pid_t id;
    /// Its standard input.
    int input;
  };

  void start(const std::string& host, const std::string& name,
             const std::vector<std::string>& plugins, const std::string& tls);

  std::map<std::string, Endpoint> endpoints_;
  std::vector<Process> processes_;
};

} // namespace castor::cli
