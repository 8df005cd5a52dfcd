// "Put X at a place" on random tables through the whole PlayMate with its arm: the camera's
// pictures, vision, the executor, the simulated arm, in simulated time.
//
//   table_benchmark [TABLES] [SEED] [MISSED_GRASP] [DROPPED] [FOLDER]
//
// FOLDER is for film strips, SEED/action-1.png.
//
// A task is solvable if there is a plan for it by the true places of things. In the end, it says
// how far off vision is, before anything is moved.

#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/benchmarks/manipulation/place_goal.hpp"
#include "castor/benchmarks/manipulation/random_table.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/body/table_things.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/components/sees_table.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;

/// Whether there is a plan by the true places; else why there is none.
std::string unsolvable(const std::string& scene, const std::string& arm_file, const PutTask& task) {
  const auto parsed = vision::parse_tabletop_scene(scene, "scene");
  const auto at = arm_placement(benchmark_arm_at);
  const TableThings things(parsed.scene.at(vision::SceneTime{0}), at);
  const auto arm = load_arm(arm_file).arm;
  ManipulationOptions options;
  options.grasps.spare = 0.024;
  const ManipulationPlanner planner(arm, options);
  const auto result =
    planner.pick_and_place(things.world().scene(), task.things.front().name(),
                           goal_at({task.x, task.y}), arm_posture(arm, benchmark_arm_rest));
  const auto* failure = std::get_if<MotionFailure>(&result);
  return failure ? failure->text : std::string{};
}

/// How a thing is seen.
struct SeenError {
  std::string shape;
  /// As vision names it.
  std::string seen_as;
  /// Seen minus true, metres.
  double width = 0;
  double height = 0;
  /// Horizontal distance of the middles, metres.
  double off = 0;
};

struct Result {
  std::vector<SeenError> seen;
  std::string reason;
  bool is_reached = false;
  double seconds = 0;
  double error = 0;
  Manipulation told;
  ArmStatus truth;
};

struct Asked {
  PutTask task;
  Result result;
  std::atomic<bool> is_over = false;
};

Asked& asked() {
  static Asked instance;
  return instance;
}

class TaskRequester final : public SeesTable<UnmanagedComponent> {
  void run() override {
    auto& result = asked().result;
    const auto& task = asked().task;
    const auto& wanted = task.things.front();
    PickAndPlace what;
    what.to.x = task.x;
    what.to.y = task.y;
    // By its place: its colour may be seen wrongly.
    const auto given_up = now() + 30s;
    while (is_running() && what.what.address.id.empty() && now() < given_up) {
      sleep_for(500ms);
      double nearest = 0.05;
      for (const auto& x : read_all_in<vision::SceneObject>("vision")) {
        const auto& at = x->box.centroid;
        const double away = std::hypot(at.x - wanted.x, at.y - wanted.y);
        if (x->shape != vision::Hypothesis{} && away < nearest) {
          nearest = away;
          what.what = EntryPointer<vision::SceneObject>{x.address};
        }
      }
    }
    if (what.what.address.id.empty()) {
      result.reason = "vision does not see it";
    } else {
      result.seen = seen_errors(task);
      const auto begun = now();
      const auto end = perform("manipulation", what).wait(600s);
      result.seconds = std::chrono::duration<double>(now() - begun).count();
      result.is_reached = end.outcome == ActionOutcome::succeeded;
      result.reason = end.reason;
    }
    for (const auto& x : read_all_in<Manipulation>("manipulation"))
      result.told = *x;
    result.truth = *pull<ArmStatus>("arm");
    for (const auto& x : result.truth.things)
      if (x.name == wanted.name())
        result.error = std::hypot(x.pose.position.x - task.x, x.pose.position.y - task.y);
    asked().is_over = true;
  }

  std::vector<SeenError> seen_errors(const PutTask& task) {
    const auto at = arm_placement(benchmark_arm_at);
    const auto seen = look_at_table(at);
    std::vector<SeenError> errors;
    for (const auto& x : task.things) {
      const auto middle =
        geometry::transform(geometry::inverse(at, arm_frame), Point3{x.x, x.y, 0});
      for (const auto& [id, colour, shape, thing] : seen) {
        const double off = distance_on_table(thing.pose.position, middle);
        const double height = x.shape == "cylinder" ? x.height : x.size;
        if (off < 0.04)
          errors.push_back(
            {x.shape, shape, thing.solid.size.x - x.size, thing.solid.size.z - height, off});
      }
    }
    return errors;
  }
};
CASTOR_COMPONENT(TaskRequester, "has a thing put somewhere")

struct Settings {
  int tables = 50;
  std::uint64_t first_seed = 1;
  std::string missed = "0";
  std::string dropped = "0";
  std::string output;
};

Result run(const PutTask& task, const std::string& scene_file, const Settings& settings,
           std::uint64_t seed) {
  asked().task = task;
  asked().result = {};
  asked().is_over = false;
  TestSystemOptions options;
  options.file = CASTOR_CONFIGS "/playmate.cast";
  options.simulated_time = true;
  options.patience = 1000s;
  options.variables = {{"arm", "true"},
                       {"table", scene_file},
                       {"arm_at", benchmark_arm_at},
                       {"arm_rest", benchmark_arm_rest},
                       {"missed_grasp", settings.missed},
                       {"dropped", settings.dropped},
                       {"output", settings.output.empty()
                                    ? std::string{}
                                    : settings.output + '/' + std::to_string(seed)},
                       {"arm_seed", std::to_string(seed)}};
  TestSystem system(text_of_file(CASTOR_CONFIGS "/playmate.cast") +
                      "SUBARCHITECTURE asking\nCPP WM SubarchitectureWorkingMemory\n"
                      "CPP TM AlwaysPositiveTaskManager\nCPP UM asker TaskRequester\n",
                    options);
  system.wait_until("the task is over", [] { return asked().is_over.load(); });
  return asked().result;
}

void print_seen(const std::vector<SeenError>& seen) {
  for (const std::string shape : {"cube", "sphere", "cylinder"}) {
    std::vector<double> widths;
    std::vector<double> heights;
    std::vector<double> off;
    int others = 0;
    for (const auto& x : seen)
      if (x.shape == shape) {
        others += x.seen_as != shape;
        widths.push_back(1000 * x.width);
        heights.push_back(1000 * x.height);
        off.push_back(1000 * x.off);
      }
    if (off.empty())
      continue;
    const auto [least_width, most_width] = std::ranges::minmax(widths);
    const auto [least_height, most_height] = std::ranges::minmax(heights);
    fmt::print("{} {}s seen, median (least to most) mm: {:.1f} ({:.1f} to {:.1f}) too wide, {:.1f} "
               "({:.1f} to {:.1f}) too high, {:.1f} (to {:.1f}) off; {} seen as another shape\n",
               off.size(), shape, median(widths), least_width, most_width, median(heights),
               least_height, most_height, median(off), std::ranges::max(off), others);
  }
}

int measure(const Settings& settings) {
  const auto scene_file =
    std::filesystem::temp_directory_path() / fmt::format("table-{}.scene", getpid());
  int solvable = 0;
  int succeeded = 0;
  std::int64_t collisions = 0;
  std::int64_t tries = 0;
  std::vector<double> seconds;
  std::vector<double> errors;
  std::vector<SeenError> seen;
  for (int i = 0; i < settings.tables; ++i) {
    const auto seed = settings.first_seed + static_cast<std::uint64_t>(i);
    const auto task = random_put_task(seed);
    const auto scene = scene_text(task.things);
    std::ofstream(scene_file) << scene;
    const auto why_not = unsolvable(scene, CASTOR_CONFIGS "/arms/katana.arm", task);
    const auto result = run(task, scene_file.string(), settings, seed);
    collisions += result.truth.collisions;
    seen.insert(seen.end(), result.seen.begin(), result.seen.end());
    solvable += why_not.empty();
    if (why_not.empty()) {
      succeeded += result.is_reached;
      tries += result.told.tries;
      if (result.is_reached) {
        seconds.push_back(result.seconds);
        errors.push_back(result.error);
      }
    }
    fmt::print("{}: {} {} to {:.2f} {:.2f}: {}; {} tries, {} motions, {:.1f} s, {:.3f} m off, {} "
               "missed, {} dropped, {} collisions{}{}\n",
               seed, task.things.front().colour, task.things.front().shape, task.x, task.y,
               result.is_reached ? "done" : result.reason, result.told.tries, result.told.plans,
               result.seconds, result.error, result.truth.missed, result.truth.dropped,
               result.truth.collisions,
               result.truth.collisions > 0 ? " (" + result.truth.collision + ")" : "",
               why_not.empty() ? "" : "; not solvable: " + why_not);
    std::fflush(stdout);
  }
  std::filesystem::remove(scene_file);
  fmt::print("{} tables, {} solvable, {} of these done, {} collisions, {:.2f} tries, median {:.1f} "
             "s, {:.3f} m off at most\n",
             settings.tables, solvable, succeeded, collisions,
             solvable > 0 ? static_cast<double>(tries) / solvable : 0, median(seconds),
             errors.empty() ? 0 : std::ranges::max(errors));
  print_seen(seen);
  return 0;
}

} // namespace

} // namespace castor::manipulation

int main(int argc, char** argv) {
  const castor::manipulation::Arguments argument{argc, argv};
  return castor::manipulation::measure({std::atoi(argument(1, "50").c_str()),
                                        std::strtoull(argument(2, "1").c_str(), nullptr, 10),
                                        argument(3, "0"), argument(4, "0"), argument(5, "")});
}
