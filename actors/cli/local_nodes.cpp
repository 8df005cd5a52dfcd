#include "castor/actors/cli/local_nodes.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace castor::cli {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// How nodes are started: in a process group of their own, so that Ctrl-C reaches this process
/// alone, which then stops everything in order.
class Attributes {
public:
  Attributes() {
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawn_file_actions_init(&actions_);
  }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  ~Attributes() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  void give(int descriptor, int as) { posix_spawn_file_actions_adddup2(&actions_, descriptor, as); }

  /// 0 or an error number.
  int spawn(pid_t& id, std::vector<std::string> arguments) {
    std::vector<char*> pointers;
    for (auto& x : arguments)
      pointers.push_back(x.data());
    pointers.push_back(nullptr);
    return posix_spawn(&id, "/proc/self/exe", &actions_, &attributes_, pointers.data(), environ);
  }

private:
  posix_spawnattr_t attributes_;
  posix_spawn_file_actions_t actions_;
};

std::array<int, 2> make_pipe() {
  std::array<int, 2> result{};
  if (pipe2(result.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(std::string{"cannot make a pipe: "} + std::strerror(errno));
  return result;
}

/// The first line that comes; empty if none does in time.
std::string first_line(int from) {
  std::string result;
  auto until = Clock::now() + 10s;
  while (Clock::now() < until) {
    pollfd x{from, POLLIN, 0};
    if (poll(&x, 1, 100) <= 0)
      continue;
    char c = 0;
    if (read(from, &c, 1) != 1)
      return {};
    if (c == '\n')
      return result;
    result += c;
  }
  return {};
}

} // namespace

LocalNodes::LocalNodes(const std::map<std::string, std::string>& names,
                       const std::vector<std::string>& plugins, const std::string& tls) {
  for (auto& [host, name] : names)
    start(host, name, plugins, tls);
}

void LocalNodes::start(const std::string& host, const std::string& name,
                       const std::vector<std::string>& plugins, const std::string& tls) {
  auto input = make_pipe();
  auto announcement = make_pipe();
  // What the node announces is not for the user; what its components print is.
  constexpr int announcements = 3;
  Attributes attributes;
  attributes.give(input[0], STDIN_FILENO);
  attributes.give(announcement[1], announcements);
  std::vector<std::string> arguments{"castor",
                                     "node",
                                     "--name",
                                     name,
                                     "--listen",
                                     "127.0.0.1:0",
                                     "--end-with-input",
                                     "--announce",
                                     std::to_string(announcements)};
  for (auto& x : plugins)
    arguments.insert(arguments.end(), {"--plugin", x});
  if (!tls.empty())
    arguments.insert(arguments.end(), {"--tls", tls + '/' + name});
  pid_t id = -1;
  int error = attributes.spawn(id, std::move(arguments));
  close(input[0]);
  close(announcement[1]);
  if (error == 0)
    processes_.push_back({id, input[1]});
  else
    close(input[1]);
  auto line = error == 0 ? first_line(announcement[0]) : std::string{};
  close(announcement[0]);
  if (line.empty())
    throw std::runtime_error("the node " + name + " could not be started on this machine" +
                             (error ? std::string{": "} + std::strerror(error) : std::string{}));
  endpoints_[host] = parse_endpoint(line, 0);
}

LocalNodes::~LocalNodes() {
  for (auto& x : processes_)
    close(x.input);
  auto until = Clock::now() + 3s;
  for (auto& x : processes_) {
    while (waitpid(x.id, nullptr, WNOHANG) == 0) {
      if (Clock::now() > until)
        kill(x.id, SIGKILL);
      poll(nullptr, 0, 10);
    }
  }
}

} // namespace castor::cli
