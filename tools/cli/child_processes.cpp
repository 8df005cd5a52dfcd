#include "castor/tools/cli/child_processes.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view child_variable = "CASTOR_CHILD=";

/// Never destroyed: the process may be ended by force at any time.
struct Children {
  std::mutex mutex;
  std::map<pid_t, std::string> marks;
};

Children& children() {
  static auto* result = new Children;
  return *result;
}

/// Whether a process was given this setting when it was started.
bool has_setting(pid_t process, const std::string& setting) {
  std::ifstream in{"/proc/" + std::to_string(process) + "/environ", std::ios::binary};
  const std::string text{std::istreambuf_iterator<char>{in}, {}};
  for (std::string_view rest = text; !rest.empty();) {
    auto end = std::min(rest.find('\0'), rest.size());
    if (rest.substr(0, end) == setting)
      return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

/// All but this one. Those of other users are not to be seen.
std::vector<pid_t> processes_with(const std::string& setting) {
  std::vector<pid_t> result;
  std::error_code error;
  for (fs::directory_iterator i{"/proc", error}, end; !error && i != end; i.increment(error)) {
    auto name = i->path().filename().string();
    pid_t process = 0;
    auto [rest, problem] = std::from_chars(name.data(), name.data() + name.size(), process);
    if (problem == std::errc{} && rest == name.data() + name.size() && process != getpid() &&
        has_setting(process, setting))
      result.push_back(process);
  }
  return result;
}

void kill_marked(const std::string& mark) {
  // Those that are found may have started others meanwhile.
  constexpr int rounds = 10;
  for (int i = 0; i < rounds; ++i) {
    auto found = processes_with(mark);
    // Zombies have no environment.
    if (found.empty())
      return;
    for (auto x : found)
      kill(x, SIGKILL);
  }
}

} // namespace

std::string new_child_mark() {
  static std::atomic<unsigned> number{0};
  return std::string{child_variable} + std::to_string(getpid()) + '-' + std::to_string(++number) +
         '-' + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count());
}

void add_child(pid_t child, const std::string& mark) {
  auto& x = children();
  std::lock_guard guard{x.mutex};
  x.marks[child] = mark;
}

int end_child(pid_t child) {
  std::string mark;
  {
    auto& x = children();
    std::lock_guard guard{x.mutex};
    mark = std::move(x.marks[child]);
    // Its number may be that of another process from now on.
    x.marks.erase(child);
  }
  // Before it is waited for: until then the number of its group is its own.
  kill(-child, SIGKILL);
  kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    // Once more.
  }
  if (!mark.empty())
    kill_marked(mark);
  return status;
}

void kill_children() {
  std::map<pid_t, std::string> marks;
  {
    auto& x = children();
    std::lock_guard guard{x.mutex};
    marks = x.marks;
    for (auto& [child, mark] : marks) {
      kill(-child, SIGKILL);
      kill(child, SIGKILL);
    }
  }
  for (auto& [child, mark] : marks)
    kill_marked(mark);
}

void kill_own_descendants() {
  auto* mark = std::getenv("CASTOR_CHILD");
  if (mark)
    kill_marked(std::string{child_variable} + mark);
}

} // namespace castor::cli
