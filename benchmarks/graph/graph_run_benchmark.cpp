// The navigation graph of configs/explorer.cast, as it ships, against the truth of the building.
//
//     graph_run_benchmark FILE.building|SEED... [VARIABLE=VALUE...]
//
// Explores each building in simulated time - a seed is that of a generated one - and compares the
// entries with the truth; then the same for graphs that are made of the keyframes again, without
// and with rooms of the grid as a second source. VARIABLE=VALUE sets a variable of the
// configuration, and pictures=FOLDER and paths=FOLDER keep a picture and the path of each.

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/text_file.hpp"
#include "castor/benchmarks/graph/simulated_tour.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/building_generator.hpp"
#include "castor/mapping/building/building_text.hpp"
#include "castor/mapping/graph/room_segments.hpp"
#include "castor/mapping/grid/types.hpp"
#include "castor/mapping/map_components/keyframe_poses.hpp"
#include "castor/mapping/map_components/types.hpp"
#include "castor/mapping/slam/types.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace castor;
using namespace castor::mapping;

/// Simulated time after which an exploration is given up.
constexpr std::chrono::minutes longest{40};

struct Explored {
  std::vector<GraphNode> nodes;
  std::vector<Keyframe> keyframes;
  std::optional<GraphPoses> poses;
  std::vector<GridTile> tiles;
  std::vector<Pose2> path;
  PathError error;
};

template <class T>
void take(const Entry& entry, std::vector<T>& to) {
  if (auto x = entry.value.as<T>())
    to.push_back(*x);
}

Explored explore(const std::string& file, const std::map<std::string, std::string>& variables) {
  cast::ParseOptions options;
  options.variables = variables;
  options.variables["building"] = file;
  options.variables.try_emplace("drive", "explore");
  auto parsed = cast::parse_file(CASTOR_CONFIGS "/explorer.cast", options);
  if (!parsed.ok())
    throw std::runtime_error(render(parsed.diagnostics));
  SystemOptions system_options;
  system_options.clock.pace = Pace{};
  System system(std::move(*parsed.architecture), system_options);
  system.start();
  system.wait({.at_most = longest});
  system.stop();
  Explored result;
  for (const auto& entry : system.entries("mapping")) {
    take(*entry, result.nodes);
    take(*entry, result.tiles);
    if (auto x = entry->value.as<PathError>())
      result.error = *x;
    if (auto x = entry->value.as<TruePath>())
      result.path = x->poses;
  }
  for (const auto& entry : system.entries("slam")) {
    take(*entry, result.keyframes);
    if (auto x = entry->value.as<GraphPoses>())
      result.poses = *x;
  }
  std::ranges::sort(result.keyframes, {}, &Keyframe::number);
  return result;
}

/// The graph of the keyframes at their final poses.
std::vector<GraphNode> made_again(const Explored& run, bool rooms) {
  GraphKeeper keeper;
  for (auto& x : run.keyframes) {
    keeper.add(x.number, std::make_shared<const LaserScan>(x.scan), x.local_pose,
               pose_in_map(x, run.poses ? &*run.poses : nullptr));
    keeper.finish();
  }
  if (rooms) {
    keeper.reconcile(room_segments(cell_map(run.tiles)));
    keeper.finish();
  }
  std::vector<GraphNode> result;
  for (auto& [id, x] : keeper.graph().nodes())
    result.push_back(x);
  return result;
}

/// As waypoints that are half a metre apart.
void write_path(const std::string& file, const std::vector<Pose2>& path) {
  std::ofstream out{file};
  std::optional<Pose2> last;
  for (auto& x : path) {
    if (last && distance(*last, x) < 0.5)
      continue;
    last = x;
    out << fmt::format("{:.2f} {:.2f}\n", x.x, x.y);
  }
}

void measure(const std::string& name, const std::string& file,
             std::map<std::string, std::string> variables) {
  const auto folder_of = [&](const char* what) {
    const auto x = variables.extract(what);
    if (x.empty())
      return std::string{};
    std::filesystem::create_directories(x.mapped());
    return x.mapped();
  };
  const auto pictures = folder_of("pictures");
  const auto paths = folder_of("paths");
  if (!pictures.empty())
    variables["output"] = pictures + "/" + name;
  const auto building = load_building(file).building;
  const auto run = explore(file, variables);
  if (!paths.empty())
    write_path(paths + "/" + name + ".path", run.path);
  // The odometry of SimulatedRobot begins at its true pose, and the map's frame is that of
  // odometry.
  const Pose2 frame;
  print_quality(name + ", entries", evaluate_nodes(run.nodes, building, run.path, frame), frame);
  fmt::print("     {} keyframes, {:.0f} m, off by {:.3f} m (median), {} collisions\n",
             run.keyframes.size(), run.error.driven, run.error.median, run.error.collisions);
  for (const bool rooms : {false, true})
    print_quality(name + (rooms ? ", with rooms" : ", without rooms"),
                  evaluate_nodes(made_again(run, rooms), building, run.path, frame), frame);
}

void run(int argc, char** argv) {
  std::map<std::string, std::string> variables;
  std::vector<std::string> buildings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (const auto equals = word.find('='); equals != word.npos)
      variables[word.substr(0, equals)] = word.substr(equals + 1);
    else
      buildings.push_back(word);
  }
  const auto folder = std::filesystem::temp_directory_path() / "castor-graph";
  std::filesystem::create_directories(folder);
  print_columns();
  for (auto& x : buildings) {
    if (x.ends_with(".building")) {
      measure(std::filesystem::path{x}.stem().string(), x, variables);
      continue;
    }
    const auto building = generate_building({.seed = std::stoull(x)});
    const auto file = folder / (building.name + ".building");
    std::ofstream{file} << building_text(building);
    measure(building.name, file.string(), variables);
  }
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "graph_run_benchmark FILE.building|SEED... [VARIABLE=VALUE...]\n");
    return 2;
  }
  try {
    run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
