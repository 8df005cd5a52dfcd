#pragma once

#include "castor/actors/runtime/push_log.hpp"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace castor {

/// Records the values that the stand-alone components of a process hand out, in one file for each,
/// on a thread of its own, so that components do not wait for the disk. Safe to use from any
/// thread.
class PushRecorder {
public:
  /// The folder must exist. Above `limit_bytes`, the oldest values are dropped.
  PushRecorder(std::filesystem::path folder, std::uint64_t limit_bytes);
  PushRecorder(const PushRecorder&) = delete;
  PushRecorder& operator=(const PushRecorder&) = delete;
  /// Writes the values that still wait.
  ~PushRecorder();

  void record(const std::string& provider, bool pushed, const Value& x);

private:
  struct Waiting {
    std::string provider;
    RecordedPush push;
  };

  void work();
  void write(const std::deque<Waiting>& batch, const std::map<std::string, std::uint64_t>& lost);
  PushLogWriter& log_of(const std::string& provider);
  void keep_limit();

  const std::filesystem::path folder_;
  const std::uint64_t limit_bytes_;
  /// Used by the thread only.
  std::map<std::string, PushLogWriter> logs_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  std::size_t waiting_bytes_ = 0;
  /// By provider.
  std::map<std::string, std::uint64_t> lost_;
  bool ending_ = false;
  std::thread thread_;
};

} // namespace castor
