#include "castor/tools/cli/running_system.hpp"

#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/private_folder.hpp"
#include "castor/actors/system/request_lines.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds time_between_looks{50};

class Connection {
public:
  explicit Connection(const fs::path& socket) : fd_(connect_to_path(socket)) {
    if (fd_ < 0) {
      error_ = errno;
      return;
    }
    // What it says is to be waited for.
    fcntl(fd_, F_SETFL, fcntl(fd_, F_GETFL) & ~O_NONBLOCK);
    if (auto peer = local_peer(fd_); !peer || !peer->is_of_this_user())
      error_ = EPERM;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (fd_ >= 0)
      close(fd_);
  }

  /// Why there is no connection with a process of this user; 0 if there is one.
  int error() const { return error_; }

  void say(const std::string& text) {
    for (std::size_t sent = 0; sent < text.size();) {
      auto n = send(fd_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (n <= 0)
        return;
      sent += static_cast<std::size_t>(n);
    }
  }

  /// Whether there is something to hear within this time.
  bool wait(std::chrono::milliseconds time) const {
    pollfd x{fd_, POLLIN, 0};
    return received_.find('\n') != std::string::npos ||
           poll(&x, 1, static_cast<int>(time.count())) > 0;
  }

  /// The next line; false at the end.
  bool hear(std::string& line) {
    for (;;) {
      if (auto end = received_.find('\n', searched_); end != std::string::npos) {
        line = received_.substr(0, end);
        received_.erase(0, end + 1);
        searched_ = 0;
        return true;
      }
      searched_ = received_.size();
      std::array<char, 65536> buffer;
      auto n = recv(fd_, buffer.data(), buffer.size(), 0);
      if (n <= 0)
        return false;
      received_.append(buffer.data(), static_cast<std::size_t>(n));
    }
  }

private:
  int fd_;
  int error_ = 0;
  std::string received_;
  std::size_t searched_ = 0;
};

std::string names_of(const std::vector<RunningSystem>& systems) {
  std::string result;
  for (auto& x : systems)
    result += (result.empty() ? "" : ", ") + x.name;
  return result;
}

} // namespace

std::vector<fs::path> sockets() {
  std::vector<fs::path> result;
  std::error_code error;
  const auto folder = runtime_folder();
  for (fs::directory_iterator i{folder, error}, end; !error && i != end; i.increment(error))
    if (std::error_code unknown; i->path().extension() == ".sock" && i->is_socket(unknown))
      result.push_back(i->path());
  if (error)
    throw std::runtime_error("cannot look for systems in the folder " + folder.string() + ": " +
                             error.message());
  return result;
}

std::size_t stale_sockets() {
  auto all = sockets();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_abandoned));
}

std::vector<RunningSystem> running_systems() {
  sweep(runtime_folder());
  std::vector<RunningSystem> result;
  for (auto& x : sockets())
    if (!is_abandoned(x))
      result.push_back({x.stem().string(), x});
  std::sort(result.begin(), result.end(), [](auto& a, auto& b) { return a.name < b.name; });
  return result;
}

RunningSystem choose_system(const std::string& wanted) {
  auto all = running_systems();
  if (all.empty())
    throw std::runtime_error("no system of this user runs on this machine; start one with "
                             "`castor run FILE`");
  auto found = all;
  std::erase_if(found, [&](auto& x) { return !x.name.starts_with(wanted); });
  if (found.size() == 1)
    return found.front();
  if (found.empty())
    throw std::runtime_error("no system of the name " + wanted +
                             " runs here; there are: " + names_of(all));
  throw std::runtime_error("several systems run here, choose one with --system: " +
                           names_of(found));
}

void ask(const RunningSystem& system, const Json& request,
         const std::function<void(const Json&)>& hear) {
  ask(system, request, hear, {});
}

void ask(const RunningSystem& system, const Json& request,
         const std::function<void(const Json&)>& hear,
         const std::function<std::vector<Json>()>& more) {
  Connection connection{system.socket};
  if (connection.error() != 0)
    throw std::runtime_error("cannot reach " + system.name + ": " +
                             std::strerror(connection.error()));
  auto text = request.dump();
  if (text.size() >= longest_request)
    throw std::runtime_error(
      fmt::format("the request is too large: it has {} bytes, a system takes "
                  "{}",
                  text.size(), longest_request));
  connection.say(text + '\n');
  std::string line;
  auto next = [&] {
    while (more && !connection.wait(time_between_looks))
      for (auto& x : more())
        connection.say(x.dump() + '\n');
    return connection.hear(line);
  };
  while (next()) {
    auto x = Json::parse(line);
    if (x.contains("error"))
      throw std::runtime_error(x["error"].get<std::string>());
    hear(x);
  }
}

Json ask_for_one(const RunningSystem& system, const Json& request) {
  Json result;
  ask(system, request, [&](const Json& x) { result = x; });
  if (result.is_null())
    throw std::runtime_error(system.name + " has ended before it answered");
  return result;
}

std::vector<Json> ask_for_all(const RunningSystem& system, const Json& request) {
  std::vector<Json> result;
  ask(system, request, [&](const Json& x) { result.push_back(x); });
  return result;
}

} // namespace castor::cli
