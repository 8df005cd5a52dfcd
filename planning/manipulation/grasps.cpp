#include "castor/planning/manipulation/grasps.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/straight_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace castor::manipulation {

namespace {

std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", length);
  return text;
}

const NamedSolid& named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.things, name, &NamedSolid::name);
  if (found == scene.things.end())
    throw std::invalid_argument("there is no " + name + " in the scene that could be grasped");
  return *found;
}

/// The things beside one: not itself, and not what it stands on.
Scene neighbours(const Scene& scene, const NamedSolid& thing) {
  constexpr double touching = 0.002;
  const double bottom = thing.pose.position.z - half_height(thing.solid, thing.pose.rotation);
  auto result = scene;
  std::erase_if(result.things, [&](const NamedSolid& x) {
    return x.name == thing.name ||
           x.pose.position.z + half_height(x.solid, x.pose.rotation) < bottom + touching;
  });
  return result;
}

class Search {
public:
  Search(const ArmModel& arm, const InverseKinematics& inverse, const Scene& scene,
         const NamedSolid& thing, const Configuration& near, const GraspOptions& options)
    : arm_(arm), inverse_(inverse), scene_(scene), thing_(thing), near_(near), options_(options),
      neighbours_(arm, neighbours(scene, thing)) {
    // nop
  }

  GraspResult run() {
    if (!arm_.gripper)
      return failure(MotionFailureKind::no_grasp, arm_.name + " has no gripper");
    const auto candidates = grasp_candidates(arm_, thing_, inverse_.is_closed_form(), options_);
    for (const auto& candidate : candidates)
      try_candidate(candidate);
    if (!grasps_.empty()) {
      std::ranges::stable_sort(grasps_, std::ranges::greater(), &Grasp::score);
      return std::move(grasps_);
    }
    if (candidates.empty())
      return failure(MotionFailureKind::no_grasp,
                     thing_.name + " is too large or too flat for the gripper: it is " +
                       metres(least_width(thing_.solid)) +
                       " wide where it is narrowest, and the gripper opens " +
                       metres(arm_.gripper->widest));
    if (!contacts_.empty())
      return blocked_goal(contacts_, thing_.name);
    return out_of_reach();
  }

private:
  MotionFailure failure(MotionFailureKind kind, std::string text) const {
    return {kind, {}, std::move(text)};
  }

  MotionFailure out_of_reach() const {
    const auto links = link_poses(arm_, near_);
    const auto& joint = links[moving_joints(arm_).front() + 1];
    const double away = geometry::distance(joint.position, thing_.pose.position);
    const double most = reach(arm_);
    if (away > most)
      return failure(MotionFailureKind::out_of_reach,
                     thing_.name + " is out of reach: it is " + metres(away) +
                       " away, and the arm reaches " + metres(most) + " at most");
    return failure(
      MotionFailureKind::out_of_reach,
      thing_.name + " is out of reach: the arm cannot turn its gripper so that it grasps it there");
  }

  void try_candidate(const GraspCandidate& candidate) {
    CollisionOptions collisions;
    collisions.opening = std::min(arm_.gripper->widest, candidate.width + options_.spare);
    collisions.may_touch = {thing_.name};
    const auto solutions = inverse_.solve(candidate.tool, near_);
    if (solutions.empty())
      return;
    CollisionChecker checker(arm_, scene_, collisions);
    for (const auto& solution : solutions) {
      if (auto contact = checker.contact(solution)) {
        contacts_.push_back(*std::move(contact));
        continue;
      }
      // Backwards, from where it ends.
      auto approach =
        way_back(arm_, inverse_, checker, solution, candidate.tool,
                 std::array{way_out(arm_, thing_, candidate.tool, options_), options_.approach});
      if (!approach)
        continue;
      std::ranges::reverse(*approach);
      add({candidate, *collisions.opening, *std::move(approach)});
      return;
    }
  }

  void add(Grasp grasp) {
    const auto& configuration = grasp.approach.back();
    grasp.clearance = neighbours_.clearance(configuration);
    grasp.score =
      options_.clearance_share * std::min(1.0, grasp.clearance / options_.enough_clearance) +
      options_.limits_share * distance_from_limits(configuration) +
      options_.steepness_share * std::abs(std::cos(grasp.candidate.tilt));
    grasps_.push_back(std::move(grasp));
  }

  /// Of the joint that moves and is nearest to one: 1 in the middle of its range, 0 at its end.
  double distance_from_limits(const Configuration& configuration) const {
    const auto moving = moving_joints(arm_);
    double result = 1;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      if (stands_still(arm_.joints[moving[i]]))
        continue;
      const double lower = arm_.joints[moving[i]].lower;
      const double upper = arm_.joints[moving[i]].upper;
      result = std::min(result, 2 * std::min(configuration[i] - lower, upper - configuration[i]) /
                                  (upper - lower));
    }
    return result;
  }

  const ArmModel& arm_;
  const InverseKinematics& inverse_;
  const Scene& scene_;
  const NamedSolid& thing_;
  const Configuration& near_;
  const GraspOptions& options_;
  CollisionChecker neighbours_;
  std::vector<Grasp> grasps_;
  std::vector<Contact> contacts_;
};

} // namespace

GraspResult find_grasps(const ArmModel& arm, const InverseKinematics& inverse, const Scene& scene,
                        const std::string& thing, const Configuration& near,
                        const GraspOptions& options) {
  return Search(arm, inverse, scene, named(scene, thing), near, options).run();
}

} // namespace castor::manipulation
