#include "castor/tools/cli/doctor_checks.hpp"

#include <fmt/core.h>

namespace castor::cli {

namespace {

/// A node with many links and journals opens some hundreds.
constexpr std::uint64_t fewest_files = 256;
constexpr std::uint64_t enough_files = 1024;

/// What is left for journals.
constexpr std::uint64_t least_disk = std::uint64_t{100} << 20;
constexpr std::uint64_t enough_disk = std::uint64_t{1} << 30;

/// Of locked memory, which drivers of cameras use.
constexpr std::uint64_t enough_locked = std::uint64_t{64} << 10;

std::string amount(std::uint64_t bytes) {
  auto x = static_cast<double>(bytes);
  return x >= 1e9 ? fmt::format("{:.1f} GB", x / 1e9) : fmt::format("{:.1f} MB", x / 1e6);
}

Finding ok(std::string check, std::string text) {
  return {std::move(check), Verdict::ok, std::move(text), {}};
}

Finding warning(std::string check, std::string text, std::string remedy) {
  return {std::move(check), Verdict::warning, std::move(text), std::move(remedy)};
}

Finding error(std::string check, std::string text, std::string remedy) {
  return {std::move(check), Verdict::error, std::move(text), std::move(remedy)};
}

} // namespace

const char* to_string(Verdict x) {
  switch (x) {
    case Verdict::ok:
      return "ok";
    case Verdict::warning:
      return "warning";
    case Verdict::error:
      return "error";
  }
  return "";
}

Finding check_libraries(const Machine& x) {
  for (auto& library : x.libraries)
    if (!library.problem.empty())
      return error("libraries", library.problem,
                   "install Castor again (scripts/install), or add the folder of its libraries to "
                   "LD_LIBRARY_PATH");
  return ok("libraries", fmt::format("castor {}, {} component libraries with {} classes", x.version,
                                     x.libraries.size(), x.classes));
}

Finding check_opencv(const Machine& x) {
  if (x.opencv.empty())
    return error("OpenCV", "its libraries are not there: vision cannot run",
                 "apt install libopencv-dev");
  return ok("OpenCV", "version " + x.opencv);
}

Finding check_configs(const Machine& x) {
  if (x.configs.empty())
    return warning("configs", "there are no example systems in " + x.configs_looked_for,
                   "name .cast files by their paths, or install Castor with scripts/install");
  return ok("configs", x.configs);
}

Finding check_port(const Machine& x) {
  if (!x.port_problem.empty())
    return warning("port", fmt::format("cannot listen at port {}: {}", x.port, x.port_problem),
                   "if that is no node of yours, start nodes with --listen ADDRESS:0 or another "
                   "port");
  return ok("port", fmt::format("{} is free for `castor node`", x.port));
}

Finding check_sockets(const Machine& x) {
  if (!x.socket_problem.empty())
    return error("sockets", x.socket_problem,
                 "until then `castor ps`, `castor wm` and their like do not find systems");
  if (x.stale_sockets > 0)
    return warning("sockets",
                   fmt::format("{} socket{} of killed systems in {}", x.stale_sockets,
                               x.stale_sockets == 1 ? "" : "s", x.socket_folder),
                   "`castor ps` removes them");
  return ok("sockets", fmt::format("{}, for this user only; {} system{} running", x.socket_folder,
                                   x.systems, x.systems == 1 ? "" : "s"));
}

Finding check_locale(const Machine& x) {
  if (!x.locale_is_there)
    return warning("locale", "the locale " + x.locale + " is not installed",
                   "sudo locale-gen " + x.locale + ", or export LC_ALL=C.UTF-8");
  if (x.character_set != "UTF-8")
    return warning("locale",
                   "the terminal's character set is " + x.character_set +
                     ": words beyond ASCII may look wrong",
                   "export LC_ALL=C.UTF-8");
  return ok("locale", x.character_set);
}

Finding check_clock(const Machine& x) {
  if (!x.clock_is_steady)
    return error("clock", "the monotonic clock does not go forward",
                 "without it timers and leases cannot work: look at the machine's clock source");
  if (x.clock_is_synchronised == false)
    return warning("clock", "the time of day is not synchronised with other machines",
                   "for systems on several machines: apt install systemd-timesyncd, or chrony");
  return ok("clock", x.clock_is_synchronised ? "steady, and synchronised by NTP" : "steady");
}

Finding check_open_files(const Machine& x) {
  if (!x.open_files)
    return ok("open files", "no limit");
  auto text = fmt::format("at most {} for a process", *x.open_files);
  constexpr auto remedy = "ulimit -n 4096";
  if (*x.open_files < fewest_files)
    return error("open files", text + ": too few for links and journals", remedy);
  if (*x.open_files < enough_files)
    return warning("open files", text + ": few for large systems", remedy);
  return ok("open files", text);
}

Finding check_core_dumps(const Machine& x) {
  if (x.core_bytes && *x.core_bytes == 0)
    return warning("core dumps", "a component that crashes leaves no core dump",
                   "ulimit -c unlimited");
  return ok("core dumps", x.core_bytes ? "at most " + amount(*x.core_bytes) : "no limit");
}

Finding check_locked_memory(const Machine& x) {
  if (x.locked_bytes && *x.locked_bytes < enough_locked)
    return warning(
      "locked memory",
      fmt::format("at most {} KB: drivers of cameras may need more", *x.locked_bytes >> 10),
      "ulimit -l unlimited, or memlock in /etc/security/limits.conf");
  return ok("locked memory", x.locked_bytes ? "at most " + amount(*x.locked_bytes) : "no limit");
}

Finding check_disk(const Machine& x) {
  if (!x.journals_can_be_written)
    return warning("disk", "journals cannot be written to " + x.journal_folder,
                   "change the folder, or give working memories a --journal-dir");
  auto text = fmt::format("{} free for journals in {}", amount(x.free_bytes), x.journal_folder);
  constexpr auto remedy = "make room, or give working memories a --journal-dir on another disk";
  if (x.free_bytes < least_disk)
    return error("disk", text, remedy);
  if (x.free_bytes < enough_disk)
    return warning("disk", text, remedy);
  return ok("disk", text);
}

Finding check_cameras(const Machine& x) {
  if (x.cameras.empty())
    return ok("cameras", "none; pictures, videos and scenes work without");
  std::string paths;
  for (auto& camera : x.cameras) {
    if (!camera.readable)
      return warning("cameras", camera.path + " is there, but this user may not open it",
                     "sudo usermod -aG video $USER, then log in again");
    paths += (paths.empty() ? "" : ", ") + camera.path;
  }
  return ok("cameras", paths);
}

std::vector<Finding> examine(const Machine& x) {
  std::vector<Finding> result;
  for (auto* check : {check_libraries, check_opencv, check_configs, check_port, check_sockets,
                      check_locale, check_clock, check_open_files, check_core_dumps,
                      check_locked_memory, check_disk, check_cameras})
    result.push_back(check(x));
  return result;
}

} // namespace castor::cli
