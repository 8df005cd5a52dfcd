#pragma once

#include "castor/base/child_process.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace castor::test {

/// Another process, whose output is gathered while it runs. Killed if it outlives this object.
class Process {
public:
  /// Starts `arguments.front()` with the rest as its arguments, and gives it `input` to read.
  explicit Process(std::vector<std::string> arguments, std::string input = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// Waits until `text` stands in what was written so far, on standard output or error; false if
  /// the process ends or the time is over before.
  bool wait_for_output(const std::string& text,
                       std::chrono::seconds patience = std::chrono::seconds{30});

  pid_t pid() const { return child_->id(); }

  void send_signal(int number);

  /// Waits for the end; the exit status, or 128 + the number of the signal that ended it.
  int wait();

  /// All that was written, complete after `wait`.
  std::string output();
  std::string errors();

private:
  void gather(int descriptor, std::string& into);

  std::optional<ChildProcess> child_;
  int input_ = -1;
  int output_ = -1;
  int errors_ = -1;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string output_text_;
  std::string error_text_;
  int open_pipes_ = 2;
  std::vector<std::thread> threads_;
};

} // namespace castor::test
