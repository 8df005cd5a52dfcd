#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace castor::cli {

/// How far a task is.
struct ProgressState {
  /// What is done: "replay".
  std::string task;
  /// In any unit, as long as `total` has the same.
  double done = 0;
  /// Nothing if nobody knows.
  std::optional<double> total;
  std::chrono::milliseconds elapsed{0};
  /// In the task's own words: "1200 of 4000 changes".
  std::string text;
};

/// The state as a line without a line break, of `columns` characters at most: the task, a bar and a
/// percentage if the total is known, the time, and the text. The bar gives way before the text
/// does.
std::string progress_line(const ProgressState& state, std::size_t columns);

} // namespace castor::cli
