#pragma once

#include "castor/base/child_process.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::benchmark {

/// A child process of this program. It should end at the end of its standard input.
class OwnProcess {
public:
  /// Returns when the process has written a line.
  explicit OwnProcess(std::vector<std::string> arguments);
  OwnProcess(const OwnProcess&) = delete;
  OwnProcess& operator=(const OwnProcess&) = delete;
  /// Waits for its end.
  ~OwnProcess();

  const std::string& first_line() const { return first_line_; }

  pid_t id() const { return child_->id(); }

  /// Sends a signal; thread-safe.
  void signal(int number) const;
  void kill() const;

private:
  std::optional<ChildProcess> child_;
  int input_ = -1;
  std::string first_line_;
};

/// Waits until the parent process closes the standard input.
void await_end_of_input();

} // namespace castor::benchmark
