// The navigation graph of a simulated robot's tour against the truth of the building.
//
//     graph_benchmark BUILDING PATH [seeds=N] [people=1] [laser=DEGREES] [slam=0] [nodes=1]
//
// One line for each seed of noise and slip. slam=0 takes the true poses; nodes=1 lists the nodes.

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
  fmt::print("seed keyframes places areas/rooms recall precision  doors found missed invented  "
             "error median most, m  width  collisions  ms/keyframe\n");
  for (int seed = 1; seed <= task.seeds; ++seed) {
    auto options = task.tour;
    options.seed = static_cast<std::uint64_t>(seed);
    const auto tour = drive_tour(building, read.path, options);
    GraphKeeper keeper;
    const auto seconds = add_tour(keeper, tour);
    const auto x = evaluate_tour(keeper, building, tour);
    fmt::print("{:4} {:9} {:6} {:5}/{:<5} {:6.3f} {:9.3f}  {:5} {:5} {:6} {:8}  {:12.3f} {:6.3f}  "
               "{:5.3f} {:10}  {:11.2f}\n",
               seed, tour.steps.size(), x.places, x.areas, x.rooms, x.area_recall, x.area_precision,
               x.doors_seen, x.doors_found, x.doors_missed.size(), x.doors_invented.size(),
               x.door_error_median, x.door_error_most, x.width_error_median, tour.collisions,
               1e3 * seconds / static_cast<double>(tour.steps.size()));
    for (auto& door : x.doors_missed)
      fmt::print("     missed {}\n", door);
    for (auto& at : x.doors_invented) {
      const auto there = transform(building.start, at);
      fmt::print("     invented at {:.2f} {:.2f}\n", there.x, there.y);
    }
    if (task.nodes)
      list(keeper, building);
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
