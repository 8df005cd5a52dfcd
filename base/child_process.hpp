#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace castor {

/// A program that is to run in a process of its own.
struct ChildProgram {
  /// A path, or a name that is looked for in $PATH.
  std::string file;
  /// The first is what the program takes for its own name.
  std::vector<std::string> arguments;
  /// "NAME=value": set besides this process's own environment, or in place of what stands there.
  std::vector<std::string> environment = {};
  /// Descriptors of this process, each with the one that it is in the child. Of the others, the
  /// child has those that are not closed on exec.
  std::vector<std::pair<int, int>> descriptors = {};
  /// A process group of its own: Ctrl-C in the terminal reaches this process alone.
  bool has_own_group = true;
};

/// A child of this process, which ends with this object. It blocks no signals.
class ChildProcess {
public:
  /// Starts the program. Throws std::system_error.
  explicit ChildProcess(ChildProgram program);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills the child, with its group if that is its own, and waits for its end, unless it is known
  /// to have ended or was released.
  ~ChildProcess();

  pid_t id() const { return id_; }

  /// Whether it has ended, without waiting; how is known from now on.
  bool has_ended();

  /// Waits for its end; how it ended, as `status` has it.
  int wait();

  /// What it returned, or 128 and the number of the signal that ended it. \pre it is known to have
  /// ended
  int status() const { return status_; }

  /// From now on it lives for itself, and somebody else has to wait for it.
  pid_t release();

private:
  void set_status(int state);

  pid_t id_ = -1;
  bool has_own_group_;
  int status_ = -1;
};

} // namespace castor
