#pragma once

#include "castor/base/child_process.hpp"

#include <optional>
#include <string>

namespace castor::communication {

/// A running external program, such as a speech recogniser. The destructor ends it.
class Program {
public:
  /// @param command as a shell understands it; its input is empty
  /// @param argument one more argument, if it is not empty
  /// @throws std::runtime_error if it cannot be started
  explicit Program(const std::string& command, const std::string& argument = {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  /// Descriptor to read its standard output from.
  int output() const { return output_; }

  /// Whether it has ended; if so, `status` is set.
  bool has_ended() { return process_->has_ended(); }

  /// Exit status; the shell's 127 for a program that does not exist. \pre it has ended
  int status() const { return process_->status(); }

private:
  std::optional<ChildProcess> process_;
  int output_ = -1;
};

} // namespace castor::communication
