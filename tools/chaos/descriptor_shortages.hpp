#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include <sys/resource.h>
#include <sys/types.h>

namespace castor::faults {

/// Lets processes run out of file descriptors: this one, and others that it may change the limits
/// of. What they have open stays open. Safe to use from any thread.
class DescriptorShortages {
public:
  DescriptorShortages() = default;
  DescriptorShortages(const DescriptorShortages&) = delete;
  DescriptorShortages& operator=(const DescriptorShortages&) = delete;
  /// Ends that of this process.
  ~DescriptorShortages();

  /// From now on the process can open nothing, unless it closes something first. Throws
  /// std::system_error.
  void begin(pid_t process);

  /// The process can open as much as before, once each `begin` has its `end`.
  void end(pid_t process);

  /// The process is not there any more.
  void forget(pid_t process);

  /// A child of this process that was started during the shortage of this process has inherited its
  /// limit, and is given the one from before.
  void raise_inherited(pid_t child);

private:
  struct Shortage {
    rlimit before{};
    int begun = 0;
    /// Held so that nobody has them.
    std::vector<int> taken;
  };

  void end_now(pid_t process);

  std::mutex mutex_;
  std::map<pid_t, Shortage> shortages_;
  /// Of this process: its limit before and during its last shortage.
  rlimit own_before_{};
  std::optional<rlim_t> own_during_;
};

} // namespace castor::faults
