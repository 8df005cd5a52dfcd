// What the builders of maps cost for each keyframe, over many rounds on one path.
//
//     builders_benchmark BUILDING PATH [ROUNDS]     12 rounds by default
//
// A simulated robot drives; its keyframes are given to the cores of NavigationGraphBuilder,
// GridBuilder and OctreeBuilder as these would. Every 10 keyframes the poses of the last 50 are
// corrected by some centimetres, every 10 s rooms are a second source of the graph. A line for each
// round: microseconds for a keyframe, its share of corrections included. Then all are corrected at
// once, and the builders are started again with all keyframes.

#include "castor/base/text_file.hpp"
#include "castor/benchmarks/graph/simulated_tour.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/graph/room_segments.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/keyframe_grid.hpp"
#include "castor/mapping/grid/tile_entries.hpp"
#include "castor/mapping/octree/anchored_octree.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace castor::mapping;

constexpr std::size_t corrected_each = 10;
constexpr std::size_t corrected = 50;
constexpr std::int64_t rooms_period = 10'000'000; // us

/// Adds up time of the processor, which other processes do not change.
class Watch {
public:
  template <class Work>
  void measure(Work&& work) {
    const auto begin = std::clock();
    work();
    time_ += std::clock() - begin;
  }

  /// Since the last time.
  double take_microseconds() {
    return 1e6 * static_cast<double>(std::exchange(time_, 0)) / CLOCKS_PER_SEC;
  }

private:
  std::clock_t time_ = 0;
};

struct Keyframes {
  std::vector<std::shared_ptr<const LaserScan>> scans;
  std::vector<Pose2> local_poses;
  std::vector<Pose2> poses;
};

/// The cores of the builders, which get what their components would give them.
class Builders {
public:
  void add(const Keyframes& all, std::size_t i) {
    graph_time_.measure([&] {
      graph_.add(static_cast<std::int64_t>(i), all.scans[i], all.local_poses[i], all.poses[i]);
      graph_.finish();
    });
    grid_time_.measure([&] {
      touched_.merge(grid_.place(std::to_string(i), all.scans[i], all.poses[i]));
      write_tiles();
    });
    octree_time_.measure([&] {
      constexpr double laser_height = 0.3;
      octree_.place(std::to_string(i),
                    std::make_shared<PointCloud>(cloud_of(*all.scans[i], {}, laser_height)),
                    all.poses[i]);
    });
  }

  void correct(const Keyframes& all, std::size_t from) {
    graph_time_.measure([&] {
      for (auto i = from; i < all.poses.size(); ++i)
        graph_.correct(static_cast<std::int64_t>(i), all.poses[i]);
      graph_.finish();
    });
    grid_time_.measure([&] {
      for (auto i = from; i < all.poses.size(); ++i)
        touched_.merge(grid_.place(std::to_string(i), nullptr, all.poses[i]));
      write_tiles();
    });
    octree_time_.measure([&] {
      for (auto i = from; i < all.poses.size(); ++i)
        octree_.place(std::to_string(i), nullptr, all.poses[i]);
    });
  }

  void rebuild_octree() {
    octree_time_.measure([&] { octree_.rebuild(); });
  }

  void reconcile() {
    rooms_time_.measure([&] {
      graph_.reconcile(room_segments(cell_map(grid_.grid())));
      graph_.finish();
    });
  }

  void print(const std::string& what, std::size_t keyframes) {
    const auto for_each = [&](Watch& x) {
      return x.take_microseconds() / static_cast<double>(keyframes);
    };
    fmt::print("{:<24}{:>8}{:>8.0f}{:>8.0f}{:>8.0f}{:>8.0f}\n", what, keyframes,
               for_each(graph_time_), for_each(rooms_time_), for_each(grid_time_),
               for_each(octree_time_));
    std::fflush(stdout);
  }

  void print_sizes() const {
    fmt::print("{} nodes, {} areas, {} tiles, {} leaves of the octree\n",
               graph_.graph().nodes().size(), graph_.graph().areas().size(), tiles_.tiles().size(),
               octree_.octree().leaves());
  }

private:
  void write_tiles() {
    tiles_.changed(grid_.grid(), touched_);
    touched_.clear();
  }

  GraphKeeper graph_;
  KeyframeGrid grid_;
  TileEntries tiles_;
  std::set<TileIndex> touched_;
  AnchoredOctree octree_{{.voxel_size = 0.1}, 0.1};
  Watch graph_time_;
  Watch rooms_time_;
  Watch grid_time_;
  Watch octree_time_;
};

/// The poses of the last keyframes, a little aside, and not twice in the same way.
void disturb(Keyframes& all, std::size_t from) {
  for (auto i = from; i < all.poses.size(); ++i)
    all.poses[i].y += i / corrected_each % 2 == 0 ? 0.03 : -0.03;
}

void run(const Building& building, const std::vector<Point2>& path, int rounds) {
  fmt::print("{:<24}{:>8}{:>8}{:>8}{:>8}{:>8}  us for each\n", "", "frames", "graph", "rooms",
             "grid", "octree");
  Keyframes all;
  Builders builders;
  std::int64_t time_of_rooms = 0;
  for (int round = 1; round <= rounds; ++round) {
    TourOptions options;
    options.seed = static_cast<std::uint64_t>(round);
    options.slam = false;
    const auto tour = drive_tour(building, path, options);
    const auto begin = all.poses.size();
    std::int64_t time = 0;
    for (auto& x : tour.steps) {
      all.scans.push_back(std::make_shared<const LaserScan>(x.keyframe.scan));
      all.local_poses.push_back(x.pose);
      all.poses.push_back(x.pose);
      builders.add(all, all.poses.size() - 1);
      if (const auto size = all.poses.size(); size > corrected && size % corrected_each == 0) {
        disturb(all, size - corrected);
        builders.correct(all, size - corrected);
      }
      time = x.keyframe.time;
      if (time - time_of_rooms >= rooms_period) {
        time_of_rooms = time;
        builders.reconcile();
      }
    }
    time_of_rooms -= time;
    builders.print(fmt::format("round {}", round), all.poses.size() - begin);
  }
  builders.print_sizes();
  for (auto& x : all.poses)
    x = {1.01 * x.x, 1.01 * x.y, x.heading};
  builders.correct(all, 0);
  builders.print("all are corrected", all.poses.size());
  builders.rebuild_octree();
  builders.print("octree made anew", all.poses.size());
  Builders again;
  for (std::size_t i = 0; i < all.poses.size(); ++i)
    again.add(all, i);
  again.print("all again", all.poses.size());
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "builders_benchmark BUILDING PATH [ROUNDS]\n");
    return 2;
  }
  try {
    const auto building = load_building(argv[1]).building;
    const auto read = parse_path(castor::load_text(argv[2]), argv[2]);
    run(building, read.path, argc > 3 ? std::max(1, std::atoi(argv[3])) : 12);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
