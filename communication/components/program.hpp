#pragma once

#include "castor/base/child_process.hpp"

#include <optional>
#include <string>

namespace castor::communication {

/// A program of the system's, such as a speech recogniser, while it runs. Ends with this object.
class Program {
public:
  /// @param command as a shell understands it; its input is empty
  /// @param argument one more argument, if it is not empty
  /// @throws std::runtime_error if it cannot be started
  explicit Program(const std::string& command, const std::string& argument = {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  /// What it prints can be read here.
  int output() const { return output_; }

  /// Whether it has ended, and how is known from now on.
  bool has_ended() { return process_->has_ended(); }

  /// 0 for well; the shell's 127 for a program that is not there. \pre it has ended
  int status() const { return process_->status(); }

private:
  std::optional<ChildProcess> process_;
  int output_ = -1;
};

} // namespace castor::communication
