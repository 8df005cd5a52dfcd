#include "castor/tools/cli/local_nodes.hpp"

#include "castor/actors/component/option.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/base/child_process.hpp"
#include "castor/base/log.hpp"

#include <fmt/core.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace castor::cli {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// Starts this program once more, to be ended with `end_child`. Throws std::system_error.
pid_t start_child(std::vector<std::string> arguments,
                  std::vector<std::pair<int, int>> descriptors) {
  auto mark = new_child_mark();
  // Ctrl-C reaches this process alone, which then stops everything in order.
  ChildProcess child{
    {"/proc/self/exe", std::move(arguments), {mark}, std::move(descriptors), true}};
  add_child(child.id(), mark);
  return child.release();
}

/// Closes its ends, but for those that were taken out.
class Pipe {
public:
  /// Throws std::runtime_error.
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::runtime_error(std::string{"cannot make a pipe: "} + std::strerror(errno));
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close_reader();
    close_writer();
  }

  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void close_reader() { close_end(ends_[0]); }
  void close_writer() { close_end(ends_[1]); }
  int take_writer() { return std::exchange(ends_[1], -1); }

private:
  static void close_end(int& x) {
    if (x >= 0)
      close(std::exchange(x, -1));
  }

  std::array<int, 2> ends_{-1, -1};
};

/// The first line that comes; empty if none does in time, or before there is something to read from
/// `wake`.
std::string first_line(int from, int wake) {
  std::string result;
  auto until = Clock::now() + 10s;
  while (Clock::now() < until) {
    std::array<pollfd, 2> x{{{from, POLLIN, 0}, {wake, POLLIN, 0}}};
    if (poll(x.data(), x.size(), 100) <= 0)
      continue;
    if (x[1].revents != 0)
      return {};
    char c = 0;
    if (read(from, &c, 1) != 1)
      return {};
    if (c == '\n')
      return result;
    result += c;
  }
  return {};
}

/// After so long it is tried again to start a process that could not be started.
constexpr std::chrono::milliseconds retry_interval{1000};

/// "was killed by signal 9 (Killed)", from what waitpid says.
std::string how_it_ended(int status) {
  if (WIFSIGNALED(status))
    return fmt::format("was killed by signal {} ({})", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
  return fmt::format("ended with status {}", WEXITSTATUS(status));
}

} // namespace

LocalNodes::LocalNodes(const std::map<std::string, LocalNode>& nodes,
                       std::vector<std::string> plugins, std::string tls)
  : plugins_(std::move(plugins)), tls_(std::move(tls)) {
  if (pipe2(wake_, O_CLOEXEC) != 0)
    throw std::runtime_error(std::string{"cannot make a pipe: "} + std::strerror(errno));
  for (auto& [host, node] : nodes) {
    auto& x = processes_[host];
    x.node = node;
    x.at.host = folder_.path() / std::to_string(processes_.size());
    start(x);
  }
  watch_ = std::thread{[this] { watch(); }};
}

void LocalNodes::start(Process& x) const {
  Pipe input;
  Pipe announcement;
  // What the node announces is not for the user; what its components print is.
  constexpr int announcements = 3;
  std::vector<std::string> arguments{
    "castor",           "node",       "--name",
    x.node.name,        "--listen",   to_string(x.at),
    "--end-with-input", "--announce", std::to_string(announcements)};
  for (auto& plugin : plugins_)
    arguments.insert(arguments.end(), {"--plugin", plugin});
  if (!tls_.empty())
    arguments.insert(arguments.end(), {"--tls", tls_ + '/' + x.node.name});
  if (x.node.memory_limit > 0)
    arguments.insert(arguments.end(), {"--memory-limit", std::to_string(x.node.memory_limit)});
  x.id = -1;
  x.started = Clock::now();
  int error = 0;
  try {
    x.id = start_child(std::move(arguments),
                       {{input.reader(), STDIN_FILENO}, {announcement.writer(), announcements}});
  } catch (const std::system_error& e) {
    error = e.code().value();
  }
  input.close_reader();
  announcement.close_writer();
  auto line = error == 0 ? first_line(announcement.reader(), wake_[0]) : std::string{};
  if (!line.empty()) {
    x.end = static_cast<int>(syscall(SYS_pidfd_open, x.id, 0));
    error = x.end < 0 ? errno : 0;
  }
  if (x.end < 0) {
    if (x.id > 0)
      end_child(std::exchange(x.id, -1));
    throw std::runtime_error("the node " + x.node.name + " could not be started on this machine" +
                             (error ? std::string{": "} + std::strerror(error) : std::string{}));
  }
  x.at = parse_endpoint(line, 0);
  x.input = input.take_writer();
}

void LocalNodes::watch() {
  for (;;) {
    std::vector<pollfd> ends{{wake_[0], POLLIN, 0}};
    std::vector<std::string> hosts{{}};
    std::vector<std::string> missing;
    {
      std::lock_guard guard{mutex_};
      for (auto& [host, x] : processes_) {
        if (x.end >= 0) {
          ends.push_back({x.end, POLLIN, 0});
          hosts.push_back(host);
        } else if (restarts_) {
          missing.push_back(host);
        }
      }
    }
    poll(ends.data(), ends.size(), missing.empty() ? -1 : static_cast<int>(retry_interval.count()));
    {
      std::lock_guard guard{mutex_};
      if (ending_)
        return;
    }
    for (auto& host : missing)
      restart(host);
    for (std::size_t i = 1; i < ends.size(); ++i)
      if (ends[i].revents != 0) {
        handle_exit(hosts[i]);
        restart(hosts[i]);
      }
  }
}

void LocalNodes::handle_exit(const std::string& host) {
  std::lock_guard guard{mutex_};
  auto& x = processes_.at(host);
  auto status = end_child(std::exchange(x.id, -1));
  close(std::exchange(x.input, -1));
  close(std::exchange(x.end, -1));
  log_runtime(LogLevel::warning, "the process of " + x.node.name + ' ' + how_it_ended(status) +
                                   (restarts_ ? "; it is started again" : ""));
}

void LocalNodes::restart(const std::string& host) {
  std::unique_lock guard{mutex_};
  if (!restarts_)
    return;
  auto& x = processes_.at(host);
  // Nobody waits for a process that takes its time.
  auto started = x;
  guard.unlock();
  try {
    start(started);
    started.failed = false;
  } catch (const std::runtime_error& e) {
    if (!std::exchange(started.failed, true))
      log_runtime(LogLevel::error, std::string{e.what()} + "; it is tried again every second");
  }
  guard.lock();
  x = std::move(started);
}

std::map<std::string, Endpoint> LocalNodes::endpoints() const {
  std::lock_guard guard{mutex_};
  std::map<std::string, Endpoint> result;
  for (auto& [host, x] : processes_)
    result[host] = x.at;
  return result;
}

bool LocalNodes::with_process(const std::string& host, const std::function<void(pid_t)>& f) const {
  std::lock_guard guard{mutex_};
  auto i = processes_.find(host);
  if (i == processes_.end() || i->second.id <= 0)
    return false;
  f(i->second.id);
  return true;
}

bool LocalNodes::kill_older(const std::string& host, Clock::time_point than) {
  std::lock_guard guard{mutex_};
  auto i = processes_.find(host);
  if (i == processes_.end() || i->second.id <= 0 || i->second.started >= than)
    return false;
  return kill(i->second.id, SIGKILL) == 0;
}

void LocalNodes::end_restarts() {
  std::lock_guard guard{mutex_};
  restarts_ = false;
}

std::map<std::string, pid_t> LocalNodes::processes() const {
  std::lock_guard guard{mutex_};
  std::map<std::string, pid_t> result;
  for (auto& [host, x] : processes_)
    if (x.id > 0)
      result[host] = x.id;
  return result;
}

LocalNodes::~LocalNodes() {
  {
    std::lock_guard guard{mutex_};
    ending_ = true;
  }
  [[maybe_unused]] auto written = write(wake_[1], "", 1);
  watch_.join();
  for (auto fd : wake_)
    close(fd);
  for (auto& [host, x] : processes_)
    if (x.input >= 0)
      close(x.input);
  auto until = Clock::now() + 3s;
  for (auto& [host, x] : processes_) {
    if (x.id > 0) {
      // What tells of its end is readable then.
      pollfd end{x.end, POLLIN, 0};
      auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
      poll(&end, 1, static_cast<int>(std::max(left, 0ms).count()));
      end_child(x.id);
    }
    if (x.end >= 0)
      close(x.end);
  }
}

std::string isolated_host(const std::string& component) {
  return component + ".isolated";
}

namespace {

/// Gives hosts of their own to the components that are to be kept apart, if they run on this
/// machine or on one of the `nodes` that do; the nodes for them, by host. Throws
/// std::invalid_argument.
std::map<std::string, LocalNode> isolate(ArchitectureDescription& architecture,
                                         const std::map<std::string, LocalNode>& nodes) {
  std::map<std::string, LocalNode> result;
  auto elsewhere = other_hosts(architecture);
  for_each_component(architecture, [&](ComponentDescription& x) {
    if (!x.is_on("isolate"))
      return;
    if (elsewhere.count(x.host) > 0 && nodes.count(x.host) == 0)
      throw std::invalid_argument(
        to_string(x.where) + ": " + x.name + " is to be isolated on " + x.host +
        ", but that is done on this machine only. Start a node for it there, with `castor node "
        "--memory-limit`, and give it a host of its own");
    std::int64_t limit = 0;
    if (auto* option = x.option("memory-limit"))
      detail::parse_option(option->value, limit);
    x.host = isolated_host(x.name);
    result[x.host] = {x.name, limit};
  });
  return result;
}

} // namespace

std::unique_ptr<LocalNodes> start_local_nodes(ArchitectureDescription& architecture,
                                              bool for_all_hosts,
                                              const std::vector<std::string>& plugins,
                                              const std::string& tls, SystemOptions& options) {
  std::map<std::string, LocalNode> nodes;
  if (for_all_hosts)
    for (auto& [host, name] : other_hosts(architecture))
      nodes[host] = {name, 0};
  nodes.merge(isolate(architecture, nodes));
  if (nodes.empty())
    return nullptr;
  auto result = std::make_unique<LocalNodes>(nodes, plugins, tls);
  options.nodes.merge(result->endpoints());
  options.kill_child = [&started = *result](const std::string& host, Clock::time_point than) {
    return started.kill_older(host, than);
  };
  return result;
}

} // namespace castor::cli
