// "Put X at a place" on random tables, as table_benchmark draws them, planned by what is known of
// them exactly, and carried out in MuJoCo: would things be lifted, and stand where the simulated
// arm, which has no physics, says they do?
//
//   physics_benchmark [TABLES=50] [SEED=1] [ERROR=0] [GRIP=15] [FRICTION=1.2]
//
// ERROR: things stand up to so many metres, along x and along y, from where the plan has them.
// GRIP: newtons of each finger. FRICTION: of fingers.

#include "castor/benchmarks/manipulation/physics/physical_table.hpp"
#include "castor/benchmarks/manipulation/place_goal.hpp"
#include "castor/benchmarks/manipulation/random_table.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/table_world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

namespace {

struct Settings {
  int tables = 50;
  std::uint64_t first_seed = 1;
  double error = 0;
  PhysicsOptions physics;
};

NamedSolid solid_of(const RandomThing& x, const Pose& arm) {
  const double height = x.shape == "cylinder" ? x.height : x.size;
  const auto solid = x.shape == "cube"     ? box(x.size, x.size, x.size)
                     : x.shape == "sphere" ? sphere(x.size)
                                           : cylinder(x.size, height);
  const Pose on_table{{x.x, x.y, height / 2},
                      geometry::rotation_about_z(x.turned * std::numbers::pi / 180),
                      geometry::table_frame};
  return {x.name(), solid, geometry::compose(geometry::inverse(arm, arm_frame), on_table)};
}

/// Where things are in physics; the plan does not know of their errors.
Scene displaced(Scene scene, double error, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = 1; i < scene.things.size(); ++i) {
    scene.things[i].pose.position.x += any(random, -error, error);
    scene.things[i].pose.position.y += any(random, -error, error);
  }
  return scene;
}

double off(const Pose& x, const Point3& from) {
  return geometry::distance(x.position, from);
}

/// What came of a plan in physics; metres.
struct Outcome {
  bool is_lifted = false;
  /// Of the thing, from where the plan has it in the end.
  double off = 0;
  /// Of others, from where they stood, the largest, and whose that is.
  double others = 0;
  std::string farthest;
  double lag = 0;
  std::vector<std::string> touched;
};

Outcome carried_out(const ManipulationPlan& plan, const ArmModel& arm, const Scene& scene,
                    const std::string& thing, const Configuration& start,
                    const PhysicsOptions& options) {
  PhysicalTable table(arm, scene, start, options);
  Outcome result;
  const double stood_at = table.pose_of(thing).position.z;
  for (const auto& stage : plan.stages) {
    table.carry_out(stage);
    // A thing that was lifted is in the air at the end of some stage.
    result.is_lifted = result.is_lifted || table.pose_of(thing).position.z > stood_at + 0.02;
  }
  result.off = off(table.pose_of(thing), plan.goal->position);
  for (std::size_t i = 1; i < scene.things.size(); ++i)
    if (const auto& x = scene.things[i]; x.name != thing) {
      const double moved = off(table.pose_of(x.name), x.pose.position);
      if (moved > result.others)
        result.farthest = x.name;
      result.others = std::max(result.others, moved);
    }
  result.lag = table.most_lag();
  result.touched = {table.touched().begin(), table.touched().end()};
  return result;
}

double share(std::vector<double> x, double share) {
  if (x.empty())
    return 0;
  std::ranges::sort(x);
  return x[static_cast<std::size_t>(share * static_cast<double>(x.size() - 1))];
}

int measure(const Settings& settings) {
  const auto arm = load_arm(CASTOR_KATANA).arm;
  const auto at = arm_placement(benchmark_arm_at);
  const auto start = arm_posture(arm, benchmark_arm_rest);
  const ManipulationPlanner planner(arm);
  std::vector<double> offs;
  int planned = 0, lifted = 0, agree = 0, others_moved = 0, touched = 0;
  for (int i = 0; i < settings.tables; ++i) {
    const auto seed = settings.first_seed + static_cast<std::uint64_t>(i);
    const auto task = random_put_task(seed);
    Scene scene{{table_top(2, 2)}, {}};
    for (const auto& x : task.things)
      scene.things.push_back(solid_of(x, at));
    const auto thing = task.things.front().name();
    const auto result = planner.pick_and_place(scene, thing, goal_at({task.x, task.y}), start);
    if (const auto* failure = std::get_if<MotionFailure>(&result)) {
      fmt::print("{}: {}: no plan: {}\n", seed, thing, failure->text);
      continue;
    }
    const auto& plan = std::get<ManipulationPlan>(result);
    const auto x = carried_out(plan, arm, displaced(scene, settings.error, seed), thing, start,
                               settings.physics);
    ++planned;
    lifted += x.is_lifted;
    offs.push_back(1000 * x.off);
    agree += x.is_lifted && x.off < 0.02;
    others_moved += x.others > 0.005 + std::numbers::sqrt2 * settings.error;
    touched += !x.touched.empty();
    fmt::print("{}: {} {}, {:.1f} mm from the plan's end, {} moved by {:.1f} mm, joints lagged by "
               "{:.4f} rad{}\n",
               seed, thing, x.is_lifted ? "lifted" : "not lifted", 1000 * x.off, x.farthest,
               1000 * x.others, x.lag,
               x.touched.empty() ? "" : fmt::format(", touched {}", fmt::join(x.touched, ", ")));
    std::fflush(stdout);
  }
  fmt::print(
    "{} tables, {} planned, {} lifted, {} within 20 mm of the plan's end; off by {:.1f} mm "
    "(median), {:.1f} (95 %), {:.1f} (largest); others moved by more than 5 mm on {}, links "
    "touched something on {}\n",
    settings.tables, planned, lifted, agree, share(offs, 0.5), share(offs, 0.95), share(offs, 1),
    others_moved, touched);
  return 0;
}

} // namespace

} // namespace castor::manipulation

int main(int argc, char** argv) {
  const castor::manipulation::Arguments argument{argc, argv};
  try {
    castor::manipulation::Settings settings;
    settings.tables = std::stoi(argument(1, "50"));
    settings.first_seed = std::stoull(argument(2, "1"));
    settings.error = std::stod(argument(3, "0"));
    settings.physics.grip = std::stod(argument(4, "15"));
    settings.physics.finger_friction = std::stod(argument(5, "1.2"));
    return castor::manipulation::measure(settings);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
