#include "castor/tests/support/process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace castor::test {

namespace {

/// Both ends close on exec: the child gets copies of those it needs, and no others.
std::pair<int, int> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  return {ends[0], ends[1]};
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    auto n = write(descriptor, text.data() + done, text.size() - done);
    if (n <= 0)
      return; // the process does not want to read it all
    done += static_cast<std::size_t>(n);
  }
}

} // namespace

Process::Process(std::vector<std::string> arguments, std::string input) {
  std::signal(SIGPIPE, SIG_IGN);
  auto [in_read, in_write] = make_pipe();
  auto [out_read, out_write] = make_pipe();
  auto [err_read, err_write] = make_pipe();
  auto file = arguments.front();
  try {
    child_.emplace(ChildProgram{
      file, std::move(arguments), {}, {{in_read, 0}, {out_write, 1}, {err_write, 2}}, false});
  } catch (const std::system_error&) {
    // Said below, when the pipes are closed.
  }
  for (int x : {in_read, out_write, err_write})
    close(x);
  if (!child_) {
    for (int x : {in_write, out_read, err_read})
      close(x);
    throw std::runtime_error("cannot start " + file);
  }
  input_ = in_write;
  output_ = out_read;
  errors_ = err_read;
  threads_.emplace_back([this] { gather(output_, output_text_); });
  threads_.emplace_back([this] { gather(errors_, error_text_); });
  threads_.emplace_back([this, text = std::move(input)] {
    write_all(input_, text);
    close(input_);
  });
}

Process::~Process() {
  if (child_->status() < 0) {
    send_signal(SIGKILL);
    wait();
  }
}

bool Process::wait_for_output(const std::string& text, std::chrono::seconds patience) {
  std::unique_lock guard{mutex_};
  auto found = [&] {
    return output_text_.find(text) != text.npos || error_text_.find(text) != text.npos;
  };
  changed_.wait_for(guard, patience, [&] { return found() || open_pipes_ == 0; });
  return found();
}

void Process::send_signal(int number) {
  kill(pid(), number);
}

int Process::wait() {
  if (child_->status() >= 0)
    return child_->status();
  for (auto& x : threads_)
    x.join();
  close(output_);
  close(errors_);
  return child_->wait();
}

std::string Process::output() {
  std::lock_guard guard{mutex_};
  return output_text_;
}

std::string Process::errors() {
  std::lock_guard guard{mutex_};
  return error_text_;
}

void Process::gather(int descriptor, std::string& into) {
  std::array<char, 4096> buffer{};
  for (;;) {
    auto n = read(descriptor, buffer.data(), buffer.size());
    std::lock_guard guard{mutex_};
    if (n > 0)
      into.append(buffer.data(), static_cast<std::size_t>(n));
    else if (n == 0 || errno != EINTR)
      --open_pipes_;
    changed_.notify_all();
    if (n == 0 || (n < 0 && errno != EINTR))
      return;
  }
}

} // namespace castor::test
