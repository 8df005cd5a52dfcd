#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace castor::cli {

/// Memory, open files and threads of a process now; nothing if there is no such process.
std::optional<faults::ResourceSample> sample_of(pid_t process);

/// Samples processes twice a second, on a thread of its own.
class ResourceWatch {
public:
  /// @param processes returns the current processes by name; called on the sampling thread
  explicit ResourceWatch(std::function<std::map<std::string, pid_t>()> processes);
  ResourceWatch(const ResourceWatch&) = delete;
  ResourceWatch& operator=(const ResourceWatch&) = delete;
  ~ResourceWatch();

  /// Stops sampling. Returns a series for each process; processes of one name differ in their ids.
  std::vector<faults::ProcessResources> stop();

private:
  void watch();

  const std::function<std::map<std::string, pid_t>()> processes_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::map<std::pair<std::string, pid_t>, std::vector<faults::ResourceSample>> samples_;
  std::thread thread_;
};

} // namespace castor::cli
