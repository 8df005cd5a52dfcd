#include "castor/communication/components/program.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace castor::communication {

Program::Program(const std::string& command, const std::string& argument) {
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(std::string{"no pipe: "} + std::strerror(errno));
  output_ = pipe[0];
  auto nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  auto script = "exec " + command + (argument.empty() ? "" : " \"$1\"");
  int error = 0;
  try {
    // A group of its own: Ctrl-C is for the system, which then ends the program.
    process_.emplace(ChildProgram{"/bin/sh",
                                  {"sh", "-c", script, "sh", argument},
                                  {},
                                  {{nothing, STDIN_FILENO}, {pipe[1], STDOUT_FILENO}},
                                  true});
  } catch (const std::system_error& e) {
    error = e.code().value();
  }
  close(nothing);
  close(pipe[1]);
  if (error != 0) {
    close(output_);
    throw std::runtime_error("\"" + command + "\" cannot be started: " + std::strerror(error));
  }
}

Program::~Program() {
  process_.reset();
  close(output_);
}

} // namespace castor::communication
