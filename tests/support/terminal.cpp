#include "castor/tests/support/terminal.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace castor::test {

namespace {

/// Of no meaning to terminals, and nobody else writes it.
constexpr char end_mark = '\x05';

} // namespace

std::vector<std::string> screen(const std::string& written) {
  std::vector<std::string> lines(1);
  std::size_t column = 0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    auto& line = lines.back();
    switch (char c = written[i]) {
      case '\r':
        column = 0;
        break;
      case '\n':
        lines.emplace_back();
        column = 0;
        break;
      case '\x1b': {
        auto end = written.find_first_of("ABCDEFGHJKSTfmnsu", i);
        if (end == written.npos)
          return lines;
        if (written[end] == 'K')
          line.resize(std::min(line.size(), column));
        i = end;
        break;
      }
      default:
        if (column < line.size())
          line[column] = c;
        else
          line += c;
        ++column;
    }
  }
  return lines;
}

Terminal::Terminal(unsigned short columns) {
  winsize size{24, columns, 0, 0};
  if (openpty(&master_, &slave_, nullptr, nullptr, &size) != 0)
    throw std::runtime_error("no pseudo-terminal");
  for (int x : {master_, slave_})
    fcntl(x, F_SETFD, FD_CLOEXEC);
  thread_ = std::thread{[this] { gather(); }};
}

Terminal::~Terminal() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    wait();
  }
  // The end of the last one who could write ends the reading.
  close(slave_);
  thread_.join();
  close(master_);
}

void Terminal::start(std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (auto& x : arguments)
    argv.push_back(x.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0)
    throw std::runtime_error("cannot fork");
  if (pid_ == 0) {
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    setsid();
    ioctl(slave_, TIOCSCTTY, 0);
    for (int x : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      dup2(slave_, x);
    execv(argv[0], argv.data());
    _exit(127);
  }
}

void Terminal::type(const std::string& text) const {
  [[maybe_unused]] auto n = write(master_, text.data(), text.size());
}

int Terminal::wait() {
  int state = 0;
  while (waitpid(pid_, &state, 0) < 0 && errno == EINTR) {
    // Once more.
  }
  pid_ = -1;
  // What the process wrote last may still be on its way through the terminal: this comes behind it.
  if (write(slave_, &end_mark, 1) == 1) {
    std::unique_lock guard{mutex_};
    changed_.wait_for(guard, std::chrono::seconds{5}, [&] {
      auto mark = written_.find(end_mark);
      if (mark != written_.npos)
        written_.erase(mark, 1);
      return mark != written_.npos;
    });
  }
  return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

bool Terminal::wait_for(const std::string& text, std::chrono::seconds patience) {
  std::unique_lock guard{mutex_};
  return changed_.wait_for(guard, patience, [&] { return written_.find(text) != written_.npos; });
}

std::string Terminal::written() {
  std::lock_guard guard{mutex_};
  return written_;
}

void Terminal::gather() {
  std::array<char, 4096> buffer{};
  for (;;) {
    auto n = read(master_, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return;
    std::lock_guard guard{mutex_};
    written_.append(buffer.data(), static_cast<std::size_t>(n));
    changed_.notify_all();
  }
}

} // namespace castor::test
