#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Failures that were injected while a guarded robot drove, and how it stopped: what is kept in a
/// file, and what a table says of it.
namespace castor::benchmark {

/// How a robot stopped after a failure.
struct Stop {
  /// From the failure until the robot brakes, and until it stands.
  double braked_ms = 0;
  double stood_ms = 0;
  /// Its way from the failure on, metres.
  double way = 0;
  /// Number of collisions so far in this run.
  std::int64_t collisions = 0;
};

struct Injection {
  std::string kind;
  Stop stop;
  /// How long the robot, its laser and its guard were ready to run meanwhile and had no processor.
  double waited_ms = 0;
};

/// Until the robot brakes, ms.
constexpr double bound_ms = 300;

/// All of one kind.
struct StopSummary {
  std::size_t count = 0;
  double braked_p50 = 0;
  double braked_max = 0;
  double stood_p50 = 0;
  double stood_max = 0;
  double way_p50 = 0;
  double way_max = 0;
  /// Later than the bound, by more than they waited for a processor; and those that would have been
  /// in time without that.
  std::size_t late = 0;
  std::size_t late_by_load = 0;
  double waited_max = 0;
  std::int64_t collisions = 0;
};

/// By kind. No kind is empty.
std::map<std::string, StopSummary> summarise(const std::vector<Injection>& injections);

/// What a file holds, one on a line, as JSON; nothing if there is no file.
/// \throws std::runtime_error naming file and line if a line cannot be read
std::vector<Injection> read_injections(const std::filesystem::path& file);

/// Appends one line.
/// \throws std::runtime_error if that is impossible
void append(const Injection& x, const std::filesystem::path& file);

} // namespace castor::benchmark
