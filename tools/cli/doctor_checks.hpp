#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The checks of `castor doctor`: plain data about a machine, and findings about it.
namespace castor::cli {

/// Properties of a machine that Castor depends on.
struct Machine {
  struct Library {
    std::string name;
    /// Why it cannot be loaded; empty if it can.
    std::string problem;
  };

  struct Device {
    std::string path;
    bool readable = true;
  };

  std::string version;
  /// Component libraries of Castor, and the number of their classes.
  std::vector<Library> libraries;
  std::size_t classes = 0;
  /// "4.6.0"; empty if it is not loaded.
  std::string opencv;
  /// Folder of the .cast files of Castor, empty if not found; and the folders that were searched.
  std::string configs;
  std::string configs_looked_for;

  std::uint16_t port = 0;
  /// Why a node cannot listen at the port; empty if it can.
  std::string port_problem;

  std::string socket_folder;
  std::string socket_problem;
  std::size_t stale_sockets = 0;
  std::size_t systems = 0;

  /// Locale of the environment, whether it is installed, and the resulting character set.
  std::string locale;
  bool locale_is_there = true;
  std::string character_set;

  bool clock_is_steady = true;
  /// Nothing if unknown.
  std::optional<bool> clock_is_synchronised;

  /// Nothing for unlimited.
  std::optional<std::uint64_t> open_files;
  std::optional<std::uint64_t> core_bytes;
  std::optional<std::uint64_t> locked_bytes;

  std::string journal_folder;
  bool journals_can_be_written = true;
  std::uint64_t free_bytes = 0;

  std::vector<Device> cameras;
};

enum class Verdict { ok, warning, error };

/// "ok", "warning", "error"
const char* to_string(Verdict x);

struct Finding {
  std::string check;
  Verdict verdict = Verdict::ok;
  std::string text;
  /// What to do; empty if all is well.
  std::string remedy;
};

Finding check_libraries(const Machine& x);
Finding check_opencv(const Machine& x);
Finding check_configs(const Machine& x);
Finding check_port(const Machine& x);
Finding check_sockets(const Machine& x);
Finding check_locale(const Machine& x);
Finding check_clock(const Machine& x);
Finding check_open_files(const Machine& x);
Finding check_core_dumps(const Machine& x);
Finding check_locked_memory(const Machine& x);
Finding check_disk(const Machine& x);
Finding check_cameras(const Machine& x);

/// All checks, in this order.
std::vector<Finding> examine(const Machine& x);

} // namespace castor::cli
