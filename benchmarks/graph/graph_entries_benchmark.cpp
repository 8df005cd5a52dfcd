// What a navigation graph costs as entries: reading one of them, one more place, and corrections of
// its end and of the whole graph.
//
//     graph_entries_benchmark [NODES]     2,000 by default

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double step = 1.05; // m; each keyframe is a place

double milliseconds(Clock::duration x) {
  return std::chrono::duration<double, std::milli>(x).count();
}

/// Says that the measurements are done.
struct Measured {
  bool done = true;
};
CASTOR_REFLECT(Measured, done)

/// Makes a path of places on rows of 50, and counts what its corrections write.
class Meter final : public UnmanagedComponent {
  void start() override {
    auto count = [this](const ChangeEvent& event) {
      ++events_;
      last_event_ = Clock::now();
      changed_.push_back(event.address);
    };
    on_change(changed<GraphNode>(), count);
    on_change(changed<GraphEdge>(), count);
    on_change(changed<Area>(), count);
    on_change(changed<RobotArea>(), [this](const ChangeEvent& event) {
      newest_ = read<RobotArea>(event.address)->keyframe;
    });
  }

  void run() override {
    for (std::int64_t i = 0; i < nodes_; ++i)
      add_keyframe();
    wait_for_keyframes();
    measure_reading();
    measure("one more place", [this] { add_keyframe(); });
    // Its end turns aside, as by a loop that ends at its last places.
    measure("correction of the last 10 keyframes", [this] {
      for (std::size_t i = poses_.size() - 10; i < poses_.size(); ++i)
        poses_[i].y += 0.05 * static_cast<double>(i + 10 - poses_.size() + 1);
      correct();
    });
    measure("correction of all keyframes", [this] {
      for (auto& x : poses_)
        x = {1.02 * x.x + 0.1, 1.02 * x.y + 0.1, x.heading};
      correct();
    });
    add(Measured{});
  }

  void add_keyframe() {
    const auto number = static_cast<std::int64_t>(poses_.size());
    const auto row = number / 50;
    const auto column = row % 2 == 0 ? number % 50 : 49 - number % 50;
    Keyframe x;
    x.number = number;
    x.time = number * 1'000'000;
    x.local_pose = {step * static_cast<double>(column), step * static_cast<double>(row), 0};
    x.scan.angle_step = 0.0174;
    x.scan.max_range = 12;
    // Nothing is near.
    x.scan.ranges.assign(181, 0);
    x.scan.time = x.time;
    add(here("keyframe " + std::to_string(number)), x);
    poses_.push_back(x.local_pose);
  }

  void wait_for_keyframes() {
    while (is_running() && newest_ + 1 < static_cast<std::int64_t>(poses_.size()))
      wait_for_changes();
  }

  void correct() {
    GraphPoses x;
    x.version = ++version_;
    x.poses = poses_;
    put(here("graph"), x);
  }

  template <class Change>
  void measure(const std::string& what, Change change) {
    events_ = 0;
    changed_.clear();
    const auto begin = Clock::now();
    change();
    wait_for_keyframes();
    // No event for so long: all have come.
    while (wait_for_changes(std::chrono::milliseconds{500})) {
    }
    std::size_t bytes = 0;
    for (auto& address : changed_)
      bytes += size_of(address);
    fmt::print("{}: {} events, {} bytes of values, {:.1f} ms until the last event\n", what, events_,
               bytes, milliseconds(last_event_ - begin));
  }

  std::size_t size_of(const Address& address) {
    if (address.id.starts_with("node-"))
      return Value::of(*read<GraphNode>(address)).encoded_size();
    if (address.id.starts_with("edge-"))
      return Value::of(*read<GraphEdge>(address)).encoded_size();
    return Value::of(*read<Area>(address)).encoded_size();
  }

  void measure_reading() {
    const auto nodes = read_all<GraphNode>();
    const auto edges = read_all<GraphEdge>();
    std::size_t bytes = 0;
    for (auto& x : nodes)
      bytes += Value::of(*x).encoded_size();
    for (auto& x : edges)
      bytes += Value::of(*x).encoded_size();
    fmt::print("{} nodes, {} edges, together {} bytes\n", nodes.size(), edges.size(), bytes);
    std::vector<double> times;
    std::size_t largest = 0;
    for (std::int64_t i = 0; i < nodes_; ++i) {
      const auto begin = Clock::now();
      const auto x = read<GraphNode>(here("node-" + std::to_string(i)));
      times.push_back(1e3 * milliseconds(Clock::now() - begin));
      largest = std::max(largest, Value::of(*x).encoded_size());
    }
    std::ranges::sort(times);
    const auto begin = Clock::now();
    const auto all = read_all<GraphNode>();
    fmt::print(
      "reading a node: {:.1f} us (median), {:.1f} us (95 %), at most {} bytes; all {} nodes "
      "{:.1f} ms\n",
      times[times.size() / 2], times[times.size() * 95 / 100], largest, all.size(),
      milliseconds(Clock::now() - begin));
  }

  Option<std::int64_t> nodes_{this, "nodes", 2000, "number of places"};

  std::vector<Pose2> poses_;
  std::vector<Address> changed_;
  std::size_t events_ = 0;
  Clock::time_point last_event_;
  std::int64_t newest_ = -1;
  std::int64_t version_ = 0;
};
CASTOR_COMPONENT(Meter, "counts what changes of a navigation graph write")

} // namespace

} // namespace castor::mapping

int main(int argc, char** argv) {
  const std::string nodes = argc > 1 ? argv[1] : "2000";
  try {
    castor::TestSystem system{"SUBARCHITECTURE mapping\n"
                              "CPP WM SubarchitectureWorkingMemory\n"
                              "CPP TM AlwaysPositiveTaskManager\n"
                              "CPP UM graph NavigationGraphBuilder\n"
                              "CPP UM meter Meter --nodes " +
                              nodes + "\n"};
    system.expect_entry("Measured in mapping", std::chrono::minutes{5});
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
