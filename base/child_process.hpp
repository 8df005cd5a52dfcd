#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace castor {

/// A program to start in a child process.
struct ChildProgram {
  /// Path, or a name that is searched for in $PATH.
  std::string file;
  /// argv: the first is the program's own name.
  std::vector<std::string> arguments;
  /// "NAME=value" pairs, added to this process's environment or replacing variables of it.
  std::vector<std::string> environment = {};
  /// Pairs of a descriptor of this process and its number in the child. Of the other descriptors,
  /// the child inherits those without close-on-exec.
  std::vector<std::pair<int, int>> descriptors = {};
  /// A process group of its own: Ctrl-C in the terminal reaches this process alone.
  bool has_own_group = true;
};

/// A child process, which is killed with this object. It blocks no signals.
class ChildProcess {
public:
  /// Starts the program. Throws std::system_error.
  explicit ChildProcess(ChildProgram program);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills the child (its whole process group, if that is its own) and waits for its end, unless it
  /// is known to have ended or was released.
  ~ChildProcess();

  pid_t id() const { return id_; }

  /// Whether it has ended; does not wait. If so, `status` is valid from now on.
  bool has_ended();

  /// Waits for its end and returns its `status`.
  int wait();

  /// Exit status, or 128 plus the number of the signal that ended it. \pre it is known to have
  /// ended
  int status() const { return status_; }

  /// Gives up the child, which then outlives this object; the caller has to wait for it.
  pid_t release();

private:
  void set_status(int state);

  pid_t id_ = -1;
  bool has_own_group_;
  int status_ = -1;
};

} // namespace castor
