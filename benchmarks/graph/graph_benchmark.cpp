// The navigation graph of a simulated robot's tour against the truth of the building.
//
//     graph_benchmark BUILDING PATH [seeds=N] [people=1] [laser=DEGREES] [slam=0] [nodes=1]
//
// Two lines for each seed of noise and slip, without and with rooms of the grid as a second source.
// slam=0 takes the true poses; nodes=1 lists the nodes.

#include "castor/base/text_file.hpp"
#include "castor/benchmarks/graph/simulated_tour.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/building/building_file.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace castor::mapping;

struct Task {
  std::string building;
  std::string path;
  int seeds = 1;
  bool nodes = false;
  TourOptions tour;
};

int number_of(std::string_view argument) {
  return std::atoi(std::string{argument.substr(argument.find('=') + 1)}.c_str());
}

bool parse(int argc, char** argv, Task& task) {
  if (argc < 3)
    return false;
  task.building = argv[1];
  task.path = argv[2];
  for (int i = 3; i < argc; ++i) {
    const std::string_view x = argv[i];
    if (x.starts_with("seeds="))
      task.seeds = number_of(x);
    else if (x.starts_with("people="))
      task.tour.people = number_of(x) != 0;
    else if (x.starts_with("laser="))
      task.tour.laser = number_of(x);
    else if (x.starts_with("slam="))
      task.tour.slam = number_of(x) != 0;
    else if (x.starts_with("nodes="))
      task.nodes = number_of(x) != 0;
    else
      return false;
  }
  return true;
}

void list(const GraphKeeper& keeper, const Building& building) {
  for (auto& [id, x] : keeper.graph().nodes()) {
    const auto at = compose(building.start, x.pose);
    const auto* room = room_at(building, {at.x, at.y});
    fmt::print("{:4} {:8} {:7.3f} {:7.3f} {:6.2f} width {:.2f} area {:2} {} neighbours {}\n", id,
               x.kind == NodeKind::place ? "place" : "gateway", at.x, at.y, at.heading, x.width,
               x.area, room ? room->name : "-", fmt::join(keeper.graph().neighbours(id), " "));
  }
}

void run(const Task& task) {
  const auto building = load_building(task.building).building;
  const auto read = parse_path(castor::load_text(task.path), task.path);
  print_columns();
  for (int seed = 1; seed <= task.seeds; ++seed) {
    auto options = task.tour;
    options.seed = static_cast<std::uint64_t>(seed);
    const auto tour = drive_tour(building, read.path, options);
    for (const bool rooms : {false, true}) {
      GraphKeeper keeper;
      const auto seconds = add_tour(keeper, tour, rooms);
      std::vector<GraphNode> nodes;
      for (auto& [id, x] : keeper.graph().nodes())
        nodes.push_back(x);
      print_quality(fmt::format("seed {}, {}", seed, rooms ? "with rooms" : "without rooms"),
                    evaluate_nodes(nodes, building, true_path(tour), building.start),
                    building.start);
      fmt::print("     {} keyframes, {:.2f} ms for each, {} collisions\n", tour.steps.size(),
                 1e3 * seconds / static_cast<double>(tour.steps.size()), tour.collisions);
      if (task.nodes)
        list(keeper, building);
    }
  }
}

} // namespace

int main(int argc, char** argv) {
  Task task;
  if (!parse(argc, argv, task)) {
    fmt::print(stderr, "graph_benchmark BUILDING PATH [seeds=N] [people=1] [laser=DEGREES] "
                       "[slam=0] [nodes=1]\n");
    return 2;
  }
  try {
    run(task);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
