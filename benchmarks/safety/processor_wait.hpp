#pragma once

#include <chrono>
#include <map>
#include <vector>

#include <sys/types.h>

namespace castor::benchmark {

/// How long processes have waited for a processor since this was made, as the kernel counts it
/// (/proc/PID/task/TID/schedstat): the time in which threads were ready and others ran. Of each
/// process the thread that waited longest, added up. What a hypervisor takes is not in it.
class ProcessorWait {
public:
  explicit ProcessorWait(std::vector<pid_t> processes);

  std::chrono::nanoseconds since() const;

private:
  /// By thread.
  using Waits = std::map<pid_t, std::chrono::nanoseconds>;

  static Waits waits_of(pid_t process);

  std::map<pid_t, Waits> begin_;
};

} // namespace castor::benchmark
