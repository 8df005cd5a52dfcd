#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace castor::test {

/// The lines that a terminal shows after this was written to it, without colours. Knows no more
/// than carriage returns, line breaks, and the sequence that erases to the end of the line.
std::vector<std::string> screen(const std::string& written);

/// A pseudo-terminal, what is written to which is gathered.
class Terminal {
public:
  explicit Terminal(unsigned short columns = 80);
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// Where programs write to.
  int descriptor() const { return slave_; }

  /// Starts a program as the session that owns the terminal; Ctrl-C is typed as "\x03".
  void start(std::vector<std::string> arguments);
  void type(const std::string& text) const;
  /// Of the program: its exit status, or 128 + the number of the signal that ended it.
  int wait();
  pid_t pid() const { return pid_; }

  /// Waits until this text was written; false if the time is over before.
  bool wait_for(const std::string& text, std::chrono::seconds patience = std::chrono::seconds{30});

  /// Everything that was written.
  std::string written();

private:
  void gather();

  int master_ = -1;
  int slave_ = -1;
  pid_t pid_ = -1;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string written_;
  std::thread thread_;
};

} // namespace castor::test
