#pragma once

#include "castor/planning/manipulation/grasps.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"
#include "castor/planning/manipulation/manipulation_plan.hpp"
#include "castor/planning/manipulation/motion_planner.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::manipulation {

struct ManipulationOptions {
  GraspOptions grasps;
  MotionPlannerOptions motions;
  TimingOptions timing{0.01, 0.6, 0.5, 0.2};
  /// Share of that speed on straight motions close to things.
  double careful = 0.5;
  /// Metres that a thing is lifted, and that the arm comes from above with it.
  double lift = 0.06;
  /// Metres above what a thing is put down on at which it is let go.
  double let_go = 0.004;
  /// Places that are tried around the wanted one, on each of two rings.
  int places = 12;
};

/// Where a thing is to be put down: the middle of its lower side, in the arm's frame.
struct PlaceGoal {
  Point3 bottom;
  /// Any place that is no further away at that height will do; metres.
  double radius = 0;
  /// What it is put down on.
  std::string support;
  /// For messages: "its place", "the red box".
  std::string text = "its place";
  /// Further turn of the thing about the vertical, radians; only hands that point straight down can
  /// do that.
  double turn = 0;
};

/// Where a thing is to be pushed to.
struct PushGoal {
  /// At least so far, in a direction in which nothing is in its way, metres.
  double distance = 0.1;
  /// The only direction, of length 1, in the arm's frame; exactly so far then.
  std::optional<Point3> along = {};
  /// Whether its middle may end at a point of the arm's frame; anywhere, if not set.
  std::function<bool(const Point3&)> may_end_at = {};
};

/// Plans what an arm does with the things of a scene. Callers in several threads wait for each
/// other.
class ManipulationPlanner {
  struct Hold;

public:
  /// Ways to take a thing of a scene.
  class WaysToTake {
    friend class ManipulationPlanner;
    std::shared_ptr<const std::vector<Hold>> holds_;
  };

  explicit ManipulationPlanner(const ArmModel& arm, const ManipulationOptions& options = {});

  /// Grasps a thing and lifts it.
  /// \throws std::invalid_argument if there is no such thing in the scene, as all of these.
  ManipulationResult pick(const Scene& scene, const std::string& thing,
                          const Configuration& start) const;

  /// Puts down what the gripper holds, with its own z axis up, and withdraws.
  ManipulationResult place(const Scene& scene, const PlaceGoal& goal,
                           const Configuration& start) const;

  /// Both; of all grasps, one that fits the place.
  ManipulationResult pick_and_place(const Scene& scene, const std::string& thing,
                                    const PlaceGoal& goal, const Configuration& start) const;

  /// All of them; motions to them are not planned.
  WaysToTake ways_to_take(const Scene& scene, const std::string& thing,
                          const Configuration& start) const;

  /// Where the thing would come to be, if there is a way to put it down there when it is taken in
  /// one of these ways; motions between them are not planned.
  std::optional<Pose> landing_of(const WaysToTake& ways, const PlaceGoal& goal) const;

  /// Pushes a thing on the table with closed fingers, off everything else, and withdraws.
  ManipulationResult push(const Scene& scene, const std::string& thing, const PushGoal& goal,
                          const Configuration& start) const;

  /// Goes to a configuration with what the gripper holds. Where it begins at or around a thing, it
  /// opens an empty gripper and draws back first, the way its fingers came if it can.
  /// @param opening of the gripper, metres
  /// @param draws_back in any case: what nobody has seen may be beside the fingers
  ManipulationResult go(const Scene& scene, const Configuration& to, const Configuration& start,
                        double opening, const std::string& text, bool draws_back = false) const;

  const ArmModel& arm() const { return arm_; }

private:
  struct Landing;
  struct WayOff;

  CollisionChecker checker(const Scene& scene, double opening,
                           const std::vector<std::string>& may_touch) const;
  MotionStage straight(CollisionChecker& checker, const std::vector<Configuration>& waypoints,
                       std::string text, double opening) const;
  MotionStage still(const Configuration& at, ManipulationStatus status, std::string text,
                    double opening, std::optional<bool> holds) const;
  std::optional<MotionFailure> move(ManipulationPlan& plan, const Scene& scene,
                                    const Configuration& start,
                                    const std::vector<Configuration>& goals, double opening,
                                    const std::string& destination, const std::string& text) const;
  std::vector<Pose> ways_up(const Pose& tool) const;
  std::optional<Hold> hold(const Scene& scene, const std::string& thing, const Grasp& grasp) const;
  std::optional<MotionFailure> add_pick(ManipulationPlan& plan, const Scene& scene,
                                        const Hold& hold, const Configuration& start) const;
  std::vector<Landing> landings(const Scene& scene, const Pose& tool, const PlaceGoal& goal,
                                const Configuration& near, double opening,
                                std::vector<Contact>& contacts) const;
  std::optional<MotionFailure> add_place(ManipulationPlan& plan, const Scene& scene,
                                         const std::vector<Landing>& landings,
                                         const PlaceGoal& goal, const Configuration& start,
                                         double opening, double released) const;
  std::optional<std::vector<Configuration>> along(CollisionChecker& checker,
                                                  const Configuration& start,
                                                  const std::vector<Pose>& poses) const;
  std::vector<std::string> touched(const Scene& scene, const Configuration& at, double opening,
                                   double margin) const;
  double opened(const Scene& scene, const Configuration& at, double opening) const;
  std::vector<WayOff> ways_off(const Scene& scene, const Configuration& start,
                               double opening) const;
  std::optional<ManipulationPlan> withdrawn(const Scene& scene, const Configuration& to,
                                            const Configuration& start, double opening,
                                            const std::string& text) const;
  MotionFailure no_landing(const Scene& scene, const PlaceGoal& goal,
                           const std::vector<Contact>& contacts) const;

  ArmModel arm_;
  ManipulationOptions options_;
  InverseKinematics inverse_;
};

} // namespace castor::manipulation
