#include "castor/benchmarks/own_process.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <utility>

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
  arguments.insert(arguments.begin(), "/proc/self/exe");
  child_.emplace(ChildProgram{.file = "/proc/self/exe",
                              .arguments = std::move(arguments),
                              .descriptors = {{in[0], STDIN_FILENO}, {out[1], STDOUT_FILENO}},
                              .has_own_group = false});
  close(in[0]);
  close(out[1]);
  input_ = in[1];
  first_line_ = read_line(out[0]);
  close(out[0]);
}

OwnProcess::~OwnProcess() {
  close(input_);
  child_->wait();
}

void OwnProcess::signal(int number) const {
  ::kill(child_->id(), number);
}

void OwnProcess::kill() const {
  signal(SIGKILL);
}

void await_end_of_input() {
  std::string line;
  std::getline(std::cin, line);
}

} // namespace castor::benchmark
