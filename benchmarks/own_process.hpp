#pragma once

#include "castor/base/child_process.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::benchmark {

/// Another process with this program. It should end when its standard input does.
class OwnProcess {
public:
  /// Returns once the process has said a line.
  explicit OwnProcess(std::vector<std::string> arguments);
  OwnProcess(const OwnProcess&) = delete;
  OwnProcess& operator=(const OwnProcess&) = delete;
  /// Waits for its end.
  ~OwnProcess();

  const std::string& first_line() const { return first_line_; }

  /// With SIGKILL; safe from any thread.
  void kill() const;

private:
  std::optional<ChildProcess> child_;
  int input_ = -1;
  std::string first_line_;
};

/// Until whoever made this process wants no more of it.
void await_end_of_input();

} // namespace castor::benchmark
