#pragma once

#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/descriptor_shortages.hpp"
#include "castor/tools/chaos/fault_schedule.hpp"
#include "castor/wm/journal/journal_fault.hpp"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace castor {
class System;
}

namespace castor::faults {

struct InjectorParts {
  /// Has to outlive the injector.
  System* system = nullptr;
  /// Calls a function with the id of the child process of that name (as used in plans); the id is
  /// not reused during the call. False if there is no such process.
  std::function<bool(const std::string& process, const std::function<void(pid_t)>& f)> with_process;
  /// The files of journals, by subarchitecture (journal_faults.hpp).
  std::map<std::string, std::filesystem::path> journals = {};
};

/// Injects the faults of a schedule into a running system, on a thread of its own.
class Injector {
public:
  using Clock = std::chrono::steady_clock;

  /// Times of the schedule are relative to now.
  Injector(InjectorParts parts, FaultSchedule schedule);
  Injector(const Injector&) = delete;
  Injector& operator=(const Injector&) = delete;
  ~Injector();

  /// Called for a change that matches a filter of the plan, given by its index in `watched_by`; may
  /// trigger a fault.
  void on_change(std::size_t filter);

  /// Injects a fault now, independently of the schedule. All its targets must be named.
  FaultRecord inject(const Fault& fault);

  /// The fault of this number has taken effect (`SystemOptions::on_fault_happened`).
  void on_happened(std::uint64_t fault);

  /// A component or a working memory is down: an armed crash of it has happened.
  void on_down(const std::string& component);

  /// Marks all armed faults as never happened.
  void conclude();

  /// Injects no more faults and continues stopped processes. Faults of links are not undone.
  void stop();

  /// Records of all faults so far.
  std::vector<FaultRecord> records() const;

private:
  /// Whether a fault was injected, and its effect or the reason why not.
  struct Outcome {
    bool done = true;
    std::string text;
    /// As in FaultRecord.
    std::string violation = {};
  };

  void work();
  void happened(FaultRecord& x);
  Timestamp now() const { return std::chrono::duration_cast<Timestamp>(Clock::now() - begin_); }
  Outcome apply(const Crash& x);
  Outcome apply(const Throw& x, std::uint64_t number);
  Outcome apply(const Hang& x, std::uint64_t number);
  Outcome apply(const Block& x, std::uint64_t number);
  Outcome apply(const Slow& x, std::uint64_t number);
  Outcome apply(const Kill& x);
  Outcome apply(const Stop& x);
  Outcome apply(const Continue& x);
  Outcome apply(const UseUpDescriptors& x);
  Outcome apply(const Flood& x);
  Outcome apply(const Partition& x, std::uint64_t number);
  Outcome apply(const Delay& x, std::uint64_t number);
  Outcome apply(const Drop& x, std::uint64_t number);
  Outcome apply(const Duplicate& x);
  Outcome apply(const Reorder& x);
  Outcome apply(const FailJournal& x, std::uint64_t number);
  Outcome apply(const SlowJournal& x, std::uint64_t number);
  Outcome apply(const RemoveJournal& x);
  Outcome apply(const ClaimJournal& x);
  Outcome apply(const JumpClock& x);

  /// As InjectorParts::with_process, but also for the coordinator.
  bool with_process(const std::string& name, const std::function<void(pid_t)>& f) const;
  Outcome signal(const std::string& process, int signal);
  void end_shortage(const std::string& name, pid_t process);
  Outcome inject_into_journal(const MemoryTarget& memory, const JournalFault& x);
  /// Calls a function at the end of a fault that lasts.
  void when_over(const Lasting& x, std::function<void()> f);
  /// Duration of a fault; until the end of the run if none is given.
  Timestamp lasting(const Lasting& x) const;

  const InjectorParts parts_;
  const Clock::time_point begin_ = Clock::now();
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  FaultSchedule schedule_;
  std::vector<DueFault> due_;
  std::multimap<Timestamp, std::function<void()>> later_;
  std::vector<FaultRecord> records_;
  /// For each record, the explanation if it never happens.
  std::vector<const char*> missed_;
  /// By component: indices of the records of its armed crashes.
  std::multimap<std::string, std::size_t> armed_crashes_;
  DescriptorShortages shortages_;
  bool over_ = false;
  std::thread thread_;
};

} // namespace castor::faults
