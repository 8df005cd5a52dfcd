#pragma once

#include "castor/benchmarks/race.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace castor::benchmark {

/// Memory by which a listener, in whatever process, tells a teller when it heard: the steady clock
/// of a machine is the same for all its processes.
class SharedPage {
public:
  /// A file of its own in /dev/shm, for a page; removed with this object.
  class File {
  public:
    File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File();

    const std::string& path() const { return path_; }

  private:
    std::string path_;
  };

  static File make() { return {}; }

  explicit SharedPage(const std::string& path);
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;
  ~SharedPage();

  /// The listener has heard once more.
  void hear();

  /// Waits until the listener has heard so often; returns when that was. Throws std::runtime_error
  /// after ten seconds.
  Clock::time_point await_heard(std::int64_t count) const;

private:
  struct Content {
    std::atomic<std::int64_t> time;
    std::atomic<std::int64_t> count;
  };

  Content* content_;
};

/// Tells again and again, each time after a pause of 300 us in which whoever was awake falls
/// asleep; returns the microseconds from the beginning of each `tell` until the listener heard.
std::vector<double> measure_hearing(const SharedPage& page, std::chrono::duration<double> duration,
                                    const std::function<void()>& tell,
                                    const std::function<void(std::chrono::nanoseconds)>& pause);

} // namespace castor::benchmark
