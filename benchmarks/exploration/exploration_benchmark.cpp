// How well the Explorer explores generated buildings, by its configuration as it ships.
//
//     exploration_benchmark [BUILDINGS] [FIRST_SEED] [ROOMS] [VARIABLE=VALUE...]
//
// Runs configs/explorer.cast with drive=explore in simulated time, for each building, and prints a
// line for each: share of the reachable floor that was seen, simulated and real time, length of the
// path, that of the same decisions with an exact laser and a known pose, a lower bound, collisions.
// VARIABLE=VALUE sets a variable of the configuration; building=FILE takes that building instead of
// generated ones; noise=N explores each building N times, with the seeds 1 to N of noise and slip.

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/benchmarks/exploration/exact_exploration.hpp"
#include "castor/benchmarks/exploration/exploration_evaluation.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/building_generator.hpp"
#include "castor/mapping/building/building_text.hpp"
#include "castor/mapping/exploration/types.hpp"
#include "castor/mapping/grid/types.hpp"
#include "castor/mapping/map_components/types.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace castor;
using namespace castor::mapping;

/// Simulated time after which an exploration is given up.
constexpr std::chrono::minutes longest{40};
/// Range of the simulated laser, metres.
constexpr double sight = 12;

struct Result {
  bool finished = false;
  SeenFloor seen;
  double simulated = 0;
  double real = 0;
  double driven = 0;
  std::int64_t collisions = 0;
};

/// What does not depend on noise, metres.
struct Reference {
  double exact = 0;
  double bound = 0;
};

/// As the configuration has the Explorer and the Navigator.
ExactExplorationOptions exact_options() {
  ExactExplorationOptions result;
  result.exploration.floor.clearance = 0.35;
  result.exploration.frontiers.least_size = 0.4;
  result.plan.cells.unknown_is_obstacle = false;
  return result;
}

Reference reference_of(const std::string& file) {
  const auto building = load_building(file).building;
  return {explore_exactly(building, exact_options()).driven,
          shortest_exploration(building, ReachableFloor(building), sight)};
}

Result explore(const std::string& file, const std::map<std::string, std::string>& variables) {
  cast::ParseOptions options;
  options.variables = variables;
  options.variables["building"] = file;
  options.variables["drive"] = "explore";
  auto parsed = cast::parse_file(CASTOR_CONFIGS "/explorer.cast", options);
  if (!parsed.ok())
    throw std::runtime_error(render(parsed.diagnostics));
  SystemOptions system_options;
  system_options.clock.pace = Pace{};
  System system(std::move(*parsed.architecture), system_options);
  const auto began = std::chrono::steady_clock::now();
  system.start();
  system.wait({.at_most = longest});
  Result result;
  result.simulated = std::chrono::duration<double>(system.now()).count();
  result.real = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  system.stop();
  std::vector<GridTile> tiles;
  for (const auto& entry : system.entries("mapping")) {
    if (auto tile = entry->value.as<GridTile>())
      tiles.push_back(*tile);
    if (auto error = entry->value.as<PathError>()) {
      result.driven = error->driven;
      result.collisions = error->collisions;
    }
  }
  for (const auto& entry : system.entries("navigation"))
    if (auto state = entry->value.as<ExplorationState>())
      result.finished = state->finished;
  const auto building = load_building(file).building;
  const ReachableFloor floor(building);
  // The odometry of SimulatedRobot begins at its true pose, and the map's frame is that of
  // odometry.
  result.seen = seen_floor(building, floor, cell_map(tiles), {});
  return result;
}

void print_line(const std::string& name, const Result& x, const Reference& reference) {
  fmt::print("{:<20} {:>8.2f} {:>8.2f} {:>8.2f} {:>9.0f} {:>7.1f} {:>9.1f} {:>8.1f} {:>8.1f} "
             "{:>6.2f} {:>10} {}\n",
             name, 100 * x.seen.known, 100 * x.seen.free_of_open, 100 * x.seen.free, x.simulated,
             x.real, x.driven, reference.exact, reference.bound,
             reference.bound > 0 ? x.driven / reference.bound : 0, x.collisions,
             x.finished ? "" : "not finished");
  std::fflush(stdout);
}

/// Explores it with each seed of noise, or with that of the variables if `seeds` is 0.
void explore_building(const std::string& name, const std::string& file,
                      std::map<std::string, std::string> variables, int seeds) {
  const auto reference = reference_of(file);
  if (seeds == 0)
    print_line(name, explore(file, variables), reference);
  for (int seed = 1; seed <= seeds; ++seed) {
    variables["seed"] = std::to_string(seed);
    print_line(fmt::format("{}, seed {}", name, seed), explore(file, variables), reference);
  }
}

int run(int argc, char** argv) {
  std::vector<std::uint64_t> numbers;
  std::map<std::string, std::string> variables;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (const auto equals = word.find('='); equals != word.npos)
      variables[word.substr(0, equals)] = word.substr(equals + 1);
    else
      numbers.push_back(std::stoull(word));
  }
  numbers.resize(3);
  int seeds = 0;
  if (const auto noise = variables.extract("noise"); !noise.empty())
    seeds = std::stoi(noise.mapped());
  fmt::print("{:<20} {:>8} {:>8} {:>8} {:>9} {:>7} {:>9} {:>8} {:>8} {:>6} {:>10}\n", "building",
             "known, %", "open, %", "free, %", "time, s", "real, s", "driven, m", "exact, m",
             "bound, m", "ratio", "collisions");
  if (variables.contains("building")) {
    explore_building("given", variables["building"], variables, seeds);
    return 0;
  }
  const auto folder = std::filesystem::temp_directory_path() / "castor-exploration";
  std::filesystem::create_directories(folder);
  const auto count = numbers[0] > 0 ? numbers[0] : 10;
  const auto first = numbers[1] > 0 ? numbers[1] : 1;
  for (auto seed = first; seed < first + count; ++seed) {
    GeneratorOptions options;
    options.seed = seed;
    if (numbers[2] > 0)
      options.rooms = static_cast<int>(numbers[2]);
    const auto building = generate_building(options);
    const auto file = folder / (building.name + ".building");
    std::ofstream{file} << building_text(building);
    explore_building(building.name, file.string(), variables, seeds);
  }
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
