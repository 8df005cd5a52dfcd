#include "castor/planning/body/arm_evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace castor::manipulation {

void evaluate(ArmEvaluation& x, const ArmStatus& status) {
  // Metres, and radians: pushes of 20 ms have less between them.
  constexpr double fall = 0.04;
  constexpr double hardly = 0.2;
  const auto& things = status.things;
  const auto held = std::ranges::find(things, "the gripper", &TrueThing::support);
  const auto before = std::ranges::find(things, x.held, &TrueThing::name);
  if (before != things.end() && before != held) {
    const double fell = x.height - before->pose.position.z;
    if (fell > fall && status.moved - x.moved < hardly && status.dropped == x.injected) {
      ++x.dropped;
      x.drop = fmt::format("{} fell by {:.2f} m", x.held, fell);
    } else {
      ++x.put_down;
    }
  }
  if (held != things.end() && held->name != x.held)
    ++x.taken;
  x.held = held == things.end() ? std::string{} : held->name;
  x.height = held == things.end() ? 0 : held->pose.position.z;
  x.fallen = std::ranges::count(things, "the floor", &TrueThing::support);
  x.collisions = status.collisions;
  x.collision = status.collision;
  x.uncommanded = std::max(x.uncommanded, status.uncommanded);
  x.injected = status.dropped;
  x.moved = status.moved;
}

} // namespace castor::manipulation
