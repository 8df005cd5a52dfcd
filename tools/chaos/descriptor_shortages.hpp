#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include <sys/resource.h>
#include <sys/types.h>

namespace castor::faults {

/// Makes processes run out of file descriptors: this one, and others whose limits it may change.
/// Open descriptors stay open. Safe to use from any thread.
class DescriptorShortages {
public:
  DescriptorShortages() = default;
  DescriptorShortages(const DescriptorShortages&) = delete;
  DescriptorShortages& operator=(const DescriptorShortages&) = delete;
  /// Ends the shortage of this process.
  ~DescriptorShortages();

  /// From now on the process can open a descriptor only after closing another. Throws
  /// std::system_error.
  void begin(pid_t process);

  /// Restores the limit once each `begin` has been followed by an `end`.
  void end(pid_t process);

  /// The process has ended.
  void forget(pid_t process);

  /// Restores the earlier limit in a child that has inherited the reduced one, having been started
  /// during a shortage of this process.
  void raise_inherited(pid_t child);

private:
  struct Shortage {
    rlimit before{};
    int begun = 0;
    /// Descriptors opened to use up the rest.
    std::vector<int> taken;
  };

  void end_now(pid_t process);

  std::mutex mutex_;
  std::map<pid_t, Shortage> shortages_;
  /// Limit of this process before and during its last shortage.
  rlimit own_before_{};
  std::optional<rlim_t> own_during_;
};

} // namespace castor::faults
