#pragma once

#include "castor/actors/faults/chaos_run.hpp"
#include "castor/actors/faults/fault_schedule.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace castor {
class System;
}

namespace castor::faults {

struct InjectorParts {
  /// Has to outlive the injector.
  System* system = nullptr;
  /// Sends a signal to a process, which has the name that plans call it by; false if there is none.
  std::function<bool(const std::string& process, int signal)> signal;
};

/// Lets the faults of a schedule befall a running system, on a thread of its own.
class Injector {
public:
  using Clock = std::chrono::steady_clock;

  /// Times of the schedule count from now.
  Injector(InjectorParts parts, FaultSchedule schedule);
  Injector(const Injector&) = delete;
  Injector& operator=(const Injector&) = delete;
  ~Injector();

  /// Something has changed, after which faults may be due. Of conditions on content none is true:
  /// the content is not looked at.
  void on_change(const ChangeEvent& event);

  /// No more faults; what was stopped goes on. Links that something befell are left to themselves.
  void stop();

  /// What was done so far.
  std::vector<FaultRecord> records() const;

private:
  /// What comes of a fault: empty if it was done, or why it could not be.
  struct Outcome {
    bool done = true;
    std::string text;
  };

  void work();
  Timestamp now() const { return std::chrono::duration_cast<Timestamp>(Clock::now() - begin_); }
  void befall(const DueFault& x);

  Outcome inject(const Crash& x);
  Outcome inject(const Throw& x);
  Outcome inject(const Hang& x);
  Outcome inject(const Slow& x);
  Outcome inject(const Kill& x);
  Outcome inject(const Stop& x);
  Outcome inject(const Continue& x);
  Outcome inject(const Partition& x);
  Outcome inject(const Delay& x);
  Outcome inject(const Drop& x);
  Outcome inject(const Duplicate& x);
  Outcome inject(const Reorder& x);
  Outcome inject(const FailJournal& x);
  Outcome inject(const SlowJournal& x);
  Outcome inject(const JumpClock& x);

  Outcome signal(const std::string& process, int signal);
  /// Something that lasts until the end of the run if nothing else is said.
  Timestamp lasting(const Lasting& x) const;

  const InjectorParts parts_;
  const Clock::time_point begin_ = Clock::now();
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  FaultSchedule schedule_;
  std::vector<DueFault> due_;
  std::multimap<Timestamp, std::function<void()>> later_;
  std::vector<FaultRecord> records_;
  bool over_ = false;
  std::thread thread_;
};

} // namespace castor::faults
