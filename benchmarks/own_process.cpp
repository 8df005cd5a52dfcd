#include "castor/benchmarks/own_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <iostream>

namespace castor::benchmark {

namespace {

std::string read_line(int descriptor) {
  std::string result;
  for (char x = 0; read(descriptor, &x, 1) == 1 && x != '\n';)
    result += x;
  return result;
}

} // namespace

OwnProcess::OwnProcess(std::vector<std::string> arguments) {
  std::array<int, 2> in{};
  std::array<int, 2> out{};
  // Others that are started meanwhile would keep the pipes open.
  if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0)
    std::abort();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  std::string self = "/proc/self/exe";
  std::vector<char*> pointers{self.data()};
  for (auto& x : arguments)
    pointers.push_back(x.data());
  pointers.push_back(nullptr);
  if (posix_spawn(&id_, self.c_str(), &actions, nullptr, pointers.data(), environ) != 0)
    std::abort();
  posix_spawn_file_actions_destroy(&actions);
  close(in[0]);
  close(out[1]);
  input_ = in[1];
  first_line_ = read_line(out[0]);
  close(out[0]);
}

OwnProcess::~OwnProcess() {
  close(input_);
  waitpid(id_, nullptr, 0);
}

void OwnProcess::kill() const {
  ::kill(id_, SIGKILL);
}

void await_end_of_input() {
  std::string line;
  std::getline(std::cin, line);
}

} // namespace castor::benchmark
