#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <unistd.h>

namespace castor::cli {

/// Progress of a long task as the last line of the terminal, redrawn ten times a second while the
/// task runs. No effect if the output is not a terminal. The line is erased at the end, also when
/// Ctrl-C ends the process. Other output needs a ProgressPause meanwhile.
///
///     Progress progress{"export"};
///     for (...)
///       if (progress.due())
///         progress.update(i, changes.size(), fmt::format("{} changes", i));
class Progress {
public:
  /// Replaces another object's line while both exist.
  explicit Progress(std::string task, int output = STDERR_FILENO);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Whether an update would be displayed: lets loops skip the formatting.
  bool due() const { return due_.load(std::memory_order_relaxed); }

  /// `total` is nothing if unknown. May be called from any thread.
  void update(double done, std::optional<double> total, std::string text = {});
  /// Update for a task without numbers.
  void update(std::string text);

  /// Whether progress is drawn on that descriptor: a terminal that can erase a line.
  static bool is_shown_on(int output);

private:
  class Display;

  std::unique_ptr<Display> display_;
  std::atomic<bool> due_{false};
};

/// Hides progress for its lifetime, so that output starts on a new line. Cheap if no progress is
/// shown.
class ProgressPause {
public:
  ProgressPause();

private:
  std::unique_lock<std::recursive_mutex> lock_;
};

} // namespace castor::cli
