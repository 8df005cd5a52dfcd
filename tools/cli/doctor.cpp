#include "castor/actors/link/private_folder.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/runtime/plugin.hpp"
#include "castor/tools/cli/bundled_file.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/doctor_checks.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>

#include <arpa/inet.h>
#include <langinfo.h>
#include <link.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/timex.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <clocale>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;

/// The version in the name of the OpenCV that is loaded, "4.6.0".
std::string opencv_version() {
  std::string result;
  auto look_at = [](dl_phdr_info* info, std::size_t, void* found) {
    std::string path = info->dlpi_name;
    if (path.find("libopencv_core.so") == path.npos)
      return 0;
    std::error_code error;
    auto name = fs::canonical(path, error).filename().string();
    auto so = name.find(".so.");
    *static_cast<std::string*>(found) = so == name.npos ? "unknown" : name.substr(so + 4);
    return 1;
  };
  dl_iterate_phdr(look_at, &result);
  return result;
}

/// Why nobody can listen at the port; empty if that is possible.
std::string port_problem(std::uint16_t port) {
  int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int yes = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  std::string result;
  if (bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0 || listen(fd, 1) != 0)
    result = errno == EADDRINUSE ? "another program uses it" : std::strerror(errno);
  close(fd);
  return result;
}

std::optional<std::uint64_t> limit(int what) {
  rlimit x{};
  if (getrlimit(static_cast<__rlimit_resource>(what), &x) != 0 || x.rlim_cur == RLIM_INFINITY)
    return std::nullopt;
  return x.rlim_cur;
}

std::string wanted_locale() {
  for (auto* name : {"LC_ALL", "LC_CTYPE", "LANG"})
    if (auto* value = std::getenv(name); value && *value)
      return value;
  return "C";
}

void look_at_software(Machine& x) {
  x.version = CASTOR_VERSION;
  for (auto& library : bundled_plugins())
    x.libraries.push_back({library, load_plugin(library).value_or("")});
  x.classes = Registry::instance().all().size();
  x.opencv = opencv_version();
  std::error_code error;
  for (auto& share : bundled_folders()) {
    auto folder = (share / "configs").string();
    x.configs_looked_for += (x.configs_looked_for.empty() ? "" : " and ") + folder;
    if (x.configs.empty() && fs::is_directory(folder, error))
      x.configs = folder;
  }
}

void look_at_sockets(Machine& x) {
  try {
    x.socket_folder = runtime_folder().string();
    x.stale_sockets = stale_sockets();
    x.systems = sockets().size() - x.stale_sockets;
  } catch (const std::exception& e) {
    x.socket_problem = e.what();
  }
}

void look_at_locale_and_clock(Machine& x) {
  x.locale = wanted_locale();
  x.locale_is_there = std::setlocale(LC_CTYPE, "") != nullptr;
  x.character_set = nl_langinfo(CODESET);
  auto before = std::chrono::steady_clock::now();
  auto after = std::chrono::steady_clock::now();
  for (int i = 0; i < 1'000'000 && after == before; ++i)
    after = std::chrono::steady_clock::now();
  x.clock_is_steady = after > before;
  timex state{};
  if (auto result = adjtimex(&state); result >= 0)
    x.clock_is_synchronised = result != TIME_ERROR && (state.status & STA_UNSYNC) == 0;
}

void look_at_limits_and_disk(Machine& x) {
  x.open_files = limit(RLIMIT_NOFILE);
  x.core_bytes = limit(RLIMIT_CORE);
  x.locked_bytes = limit(RLIMIT_MEMLOCK);
  std::error_code error;
  fs::path folder = fs::is_directory("journals", error) ? "journals" : ".";
  x.journal_folder = fs::absolute(folder, error).lexically_normal().string();
  x.journals_can_be_written = access(folder.c_str(), W_OK) == 0;
  x.free_bytes = fs::space(folder, error).available;
}

void look_at_cameras(Machine& x) {
  std::error_code error;
  for (auto& device : fs::directory_iterator{"/dev", error})
    if (device.path().filename().string().starts_with("video"))
      x.cameras.push_back(
        {device.path().string(), access(device.path().c_str(), R_OK | W_OK) == 0});
  std::sort(x.cameras.begin(), x.cameras.end(), [](auto& a, auto& b) { return a.path < b.path; });
}

Machine look_at_machine() {
  Machine result;
  look_at_software(result);
  result.port = default_node_port;
  result.port_problem = port_problem(result.port);
  look_at_sockets(result);
  look_at_locale_and_clock(result);
  look_at_limits_and_disk(result);
  look_at_cameras(result);
  return result;
}

std::string as_text(const Finding& x) {
  std::string state = to_string(x.verdict);
  std::transform(state.begin(), state.end(), state.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  auto result = fmt::format("{:<8} {:<14} {}\n", state, x.check, x.text);
  return x.remedy.empty() ? result : result + fmt::format("{:<23} -> {}\n", "", x.remedy);
}

int doctor(bool json) {
  int status = success;
  for (auto& x : examine(look_at_machine())) {
    if (x.verdict == Verdict::error)
      status = a_component_failed;
    print(json ? Json{{"check", x.check},
                      {"state", to_string(x.verdict)},
                      {"finding", x.text},
                      {"remedy", x.remedy}}
                     .dump() +
                   '\n'
               : as_text(x));
  }
  return status;
}

} // namespace

void add_doctor(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
    "doctor", "check this machine for what Castor needs, and how to fix what is missing");
  auto json = std::make_shared<bool>(false);
  add_json_flag(*command, *json);
  command->footer(
    "Each line is OK, WARNING or ERROR, with a remedy. Exit status 1 if there is an error.\n"
    "Looks at libraries, OpenCV, example systems, the port of nodes, sockets, locale, clock, "
    "limits,\nthe disk for journals in this folder, and cameras.\n"
    "Examples: castor doctor\n"
    "          castor doctor --json | jq 'select(.state != \"ok\")'");
  on_call(*command, chosen, json, doctor);
}

} // namespace castor::cli
