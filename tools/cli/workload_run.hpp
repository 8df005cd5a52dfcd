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

/// Does to a running system what a workload says, as an operator from outside, and notices what
/// comes of it. What cannot be done now, since somebody is down, is done as soon as it can.
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

  /// Throws std::runtime_error if there is no folder for its files, and std::length_error if there
  /// is too much to do.
  WorkloadRun(const CheckedWorkload& workload, std::uint64_t seed, Timestamp duration);
  WorkloadRun(const WorkloadRun&) = delete;
  WorkloadRun& operator=(const WorkloadRun&) = delete;
  ~WorkloadRun();

  /// Lets cameras look at a copy of their scene, which can be changed.
  void prepare(ArchitectureDescription& architecture);

  /// To be called before the system is made, after all else that is called when something is up.
  void watch(SystemOptions& options);

  /// The system has started: times count from now.
  void begin();

  /// Nothing new is begun. Waits until what was begun is done, though not for ever.
  void finish_actions();

  /// To be called at rest, before the system stops. What became of it.
  faults::WorkloadRecord end();

  /// What became of the sentences; once it has ended.
  const std::vector<faults::Sentence>& sentences() const { return sentences_.all(); }

private:
  /// Something that is to be done now.
  struct Task {
    faults::Action action;
    std::size_t statement = 0;
    /// Of a sentence: its place among them. Of others: which of the statement's it is.
    std::size_t number = 0;
    bool was_tried = false;
    /// Was done before, and maybe lost.
    bool again = false;
  };

  Timestamp now() const { return std::chrono::duration_cast<Timestamp>(Clock::now() - begin_); }

  void act();
  void take_due();
  /// Tries what is to be done; what cannot be done stays.
  void try_tasks();
  /// Throws std::runtime_error if it cannot be done now.
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
