#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/link/private_folder.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/chaos/sentences.hpp"
#include "castor/tools/chaos/workload_record.hpp"
#include "castor/tools/chaos/workload_schedule.hpp"
#include "castor/tools/cli/read_workload.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace castor::cli {

/// Performs the actions of a workload on a running system, as an operator from outside, and records
/// their results. Actions that fail because a component is down are retried.
///
///     WorkloadRun work{workload, seed, duration};
///     work.prepare(architecture);
///     work.watch(options);
///     System system{architecture, options};
///     system.start();
///     work.begin();
///     ...
///     work.finish_actions();
///     (the system comes to rest)
///     auto record = work.end();
///     system.stop();
class WorkloadRun {
public:
  using Clock = std::chrono::steady_clock;

  /// Throws std::runtime_error if no folder for its files can be made, and std::length_error if the
  /// workload has too many actions.
  WorkloadRun(const CheckedWorkload& workload, std::uint64_t seed, Timestamp duration);
  WorkloadRun(const WorkloadRun&) = delete;
  WorkloadRun& operator=(const WorkloadRun&) = delete;
  ~WorkloadRun();

  /// Makes cameras show a copy of their scene, which can be changed.
  void prepare(ArchitectureDescription& architecture);

  /// To be called before the system is made, after all other handlers of `on_up` are set.
  void watch(SystemOptions& options);

  /// To be called when the system has started: times are relative to now.
  void begin();

  /// Begins no further actions. Waits, for a limited time, until those begun are done.
  void finish_actions();

  /// To be called when the system has settled, before it stops. Returns the results.
  faults::WorkloadRecord end();

  /// The sentences and their answers; to be called after `end`.
  const std::vector<faults::Sentence>& sentences() const { return sentences_.all(); }

private:
  /// An action that is due.
  struct Task {
    faults::Action action;
    std::size_t statement = 0;
    /// For a sentence: its index among the sentences. Otherwise its number among the actions of its
    /// statement.
    std::size_t number = 0;
    bool was_tried = false;
    /// A repetition of an action that may have been lost.
    bool again = false;
  };

  Timestamp now() const { return std::chrono::duration_cast<Timestamp>(Clock::now() - begin_); }

  void act();
  void take_due();
  /// Tries all due actions; keeps those that fail.
  void try_tasks();
  /// Throws std::runtime_error if it is not possible now.
  void carry_out(const Task& task);
  void say(const faults::Say& x, const Task& task);
  void write(const faults::WriteEntry& x, const Task& task);
  void change_scene(const faults::Action& x);
  bool exists(const std::string& subarchitecture, const std::string& id) const;
  void say_again();

  void listen();
  void hear(const Json& output, std::optional<Timestamp> at);

  const CheckedWorkload& workload_;
  const RunFolder folder_;
  const RunningSystem system_;
  const std::filesystem::path scene_file_;
  std::vector<faults::DueAction> schedule_;
  std::optional<faults::SceneText> scene_;
  Clock::time_point begin_ = Clock::now();
  Timestamp took_{0};

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0;
  std::deque<Task> tasks_;
  faults::Sentences sentences_;
  std::vector<faults::StatementRecord> statements_;
  bool memory_was_lost_ = false;
  bool is_finishing_ = false;
  std::atomic<bool> is_over_ = false;
  std::vector<std::thread> threads_;
};

} // namespace castor::cli
