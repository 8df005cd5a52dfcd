#include "castor/communication/components/program.hpp"

#include <array>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace castor::communication {

Program::Program(const std::string& command, const std::string& argument) {
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(std::string{"no pipe: "} + std::strerror(errno));
  output_ = pipe[0];
  auto script = "exec " + command + (argument.empty() ? "" : " \"$1\"");
  const std::array<const char*, 6> arguments{"sh",   "-c", script.c_str(), "sh", argument.c_str(),
                                             nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  // A group of its own: Ctrl-C is for the system, which then ends the program.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  const int error = posix_spawn(&id_, "/bin/sh", &actions, &attributes,
                                const_cast<char* const*>(arguments.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(pipe[1]);
  if (error != 0) {
    close(output_);
    throw std::runtime_error("\"" + command + "\" cannot be started: " + std::strerror(error));
  }
}

Program::~Program() {
  if (!has_ended()) {
    kill(-id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  close(output_);
}

bool Program::has_ended() {
  int status = 0;
  if (status_ < 0 && waitpid(id_, &status, WNOHANG) == id_)
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return status_ >= 0;
}

} // namespace castor::communication
