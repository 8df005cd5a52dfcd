#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <unistd.h>

namespace castor::cli {

/// Progress of a long task as the last line of the terminal, redrawn ten times a second while the
/// task goes on. Nothing at all if the output is no terminal. The line is erased at the end, also
/// when Ctrl-C ends the process. Whoever prints something meanwhile makes a ProgressPause.
///
///     Progress progress{"export"};
///     for (...)
///       if (progress.due())
///         progress.update(i, changes.size(), fmt::format("{} changes", i));
class Progress {
public:
  /// One that is made while another one lives is shown in its place.
  explicit Progress(std::string task, int output = STDERR_FILENO);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Whether an update would be seen: for loops that have better things to do than to make texts.
  bool due() const { return due_.load(std::memory_order_relaxed); }

  /// `total` is nothing if nobody knows it. May be called by any thread.
  void update(double done, std::optional<double> total, std::string text = {});
  /// For what has no numbers.
  void update(std::string text);

  /// Whether something is drawn there: a terminal that can erase a line.
  static bool is_shown_on(int output);

private:
  class Display;

  std::unique_ptr<Display> display_;
  std::atomic<bool> due_{false};
};

/// Keeps progress off the terminal for its lifetime, so that what is printed stands on lines of its
/// own. Costs next to nothing where no progress is shown.
class ProgressPause {
public:
  ProgressPause();

private:
  std::unique_lock<std::recursive_mutex> lock_;
};

} // namespace castor::cli
