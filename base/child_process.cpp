#include "castor/base/child_process.hpp"

#include <cerrno>
#include <csignal>
#include <string_view>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace castor {

namespace {

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (auto& x : texts)
    result.push_back(x.data());
  result.push_back(nullptr);
  return result;
}

/// This process's variables, but for those that are set anew.
std::vector<char*> environment_with(std::vector<std::string>& set) {
  std::vector<char*> result;
  auto is_set = [&](std::string_view variable) {
    for (auto& x : set)
      if (variable.starts_with(x.substr(0, x.find('=') + 1)))
        return true;
    return false;
  };
  for (auto& x : set)
    result.push_back(x.data());
  for (auto** x = environ; *x; ++x)
    if (!is_set(*x))
      result.push_back(*x);
  result.push_back(nullptr);
  return result;
}

/// 0 or an error number.
int spawn(pid_t& id, ChildProgram& program) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (auto& [here, there] : program.descriptors)
    posix_spawn_file_actions_adddup2(&actions, here, there);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  int flags = POSIX_SPAWN_SETSIGMASK | (program.has_own_group ? POSIX_SPAWN_SETPGROUP : 0);
  posix_spawnattr_setflags(&attributes, static_cast<short>(flags));
  auto arguments = pointers_to(program.arguments);
  auto environment = environment_with(program.environment);
  int error = posix_spawnp(&id, program.file.c_str(), &actions, &attributes, arguments.data(),
                           environment.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return error;
}

} // namespace

ChildProcess::ChildProcess(ChildProgram program) : has_own_group_(program.has_own_group) {
  if (int error = spawn(id_, program))
    throw std::system_error(error, std::generic_category(), program.file);
}

ChildProcess::~ChildProcess() {
  if (id_ < 0 || has_ended())
    return;
  kill(has_own_group_ ? -id_ : id_, SIGKILL);
  wait();
}

void ChildProcess::set_status(int state) {
  status_ = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

bool ChildProcess::has_ended() {
  int state = 0;
  if (status_ < 0 && waitpid(id_, &state, WNOHANG) == id_)
    set_status(state);
  return status_ >= 0;
}

int ChildProcess::wait() {
  int state = 0;
  while (status_ < 0) {
    auto ended = waitpid(id_, &state, 0);
    if (ended == id_)
      set_status(state);
    else if (errno != EINTR)
      break;
  }
  return status_;
}

pid_t ChildProcess::release() {
  return std::exchange(id_, -1);
}

} // namespace castor
