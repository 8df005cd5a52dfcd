#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace castor::cli {

/// Progress of a task.
struct ProgressState {
  /// Name of the task: "replay".
  std::string task;
  /// Amount done, in the unit of `total`.
  double done = 0;
  /// Nothing if unknown.
  std::optional<double> total;
  std::chrono::milliseconds elapsed{0};
  /// Description by the task: "1200 of 4000 changes".
  std::string text;
};

/// The state as a line without a line break, of `columns` characters at most: the task, a bar and a
/// percentage if the total is known, the time, and the text. The bar is shortened before the text.
std::string progress_line(const ProgressState& state, std::size_t columns);

} // namespace castor::cli
