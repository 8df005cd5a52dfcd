#pragma once

#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/actions.hpp"
#include "castor/planning/manipulation/arm_action_queue.hpp"
#include "castor/planning/manipulation/components/commands_arm.hpp"
#include "castor/planning/manipulation/components/sees_table.hpp"
#include "castor/planning/manipulation/failure_report.hpp"
#include "castor/planning/manipulation/hidden_posture.hpp"
#include "castor/planning/manipulation/joint_watch.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/placed_things.hpp"
#include "castor/planning/manipulation/reach_map.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/manipulation/way_between.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace castor::manipulation {

/// A component that executes actions of an arm: how it looks, plans, moves, and tells of it.
class ExecutesManipulation : public SeesTable<CommandsArm> {
protected:
  void configure() override {
    CommandsArm::configure();
    able_to(arm());
    rests_at_ = rest();
  }

  /// Plans with that model from now on.
  void able_to(const ArmModel& arm) {
    able_ = arm;
    ManipulationOptions options;
    options.grasps.spare = spare_;
    options.timing.speed_share = speed_;
    options.timing.acceleration_share = acceleration_;
    options.motions.time_limit = planning_time_;
    options.motions.algorithm = planning_algorithm(algorithm_.get());
    stops_between_.reset();
    ways_.clear();
    ways_among_others_.clear();
    planner_.emplace(able_, options);
    ReachMapOptions reach;
    reach.width = table_width_;
    reach.depth = table_depth_;
    reach.grasps = options.grasps;
    grasps_ = options.grasps;
    reach_ = reach_map(able_, InverseKinematics(able_), placement(), reach);
  }

  /// All joints are tried again, also those that did not move any more.
  void trust_joints() {
    still_joints_.clear();
    able_to(arm());
    rests_at_ = rest();
  }

  /// From where it is planned.
  Configuration joints() const { return kept_within_limits(able_, state()->positions); }

  // -- what it says

  void begin(const std::string& task, const EntryPointer<vision::SceneObject>& what) {
    ways_.clear();
    ways_among_others_.clear();
    told_ = {};
    told_.task = task;
    told_.what = what;
    tell(ManipulationStatus::looking, "looks at the table");
  }

  /// Where the arm reaches with what it holds now.
  void tell_reach() {
    reach_.held_ways =
      held_ ? ways_held(held_->pose, grasps_) : spatial::ReachableTable{}.held_ways;
    put(here(reach_entry), reach_);
  }

  /// Whether a thing is on the table there, with all of it, and where the arm grasps things.
  /// @param at in the table's frame
  bool is_within_reach(const Point3& at, double radius) const {
    return std::abs(at.x) + radius <= table_width_ / 2 &&
           std::abs(at.y) + radius <= table_depth_ / 2 && is_reached(reach_, {at.x, at.y});
  }

  ActionResult finish(ActionResult result) {
    tell_reach();
    told_.reason = result.reason;
    tell(result.outcome == ActionOutcome::succeeded   ? ManipulationStatus::succeeded
         : result.outcome == ActionOutcome::cancelled ? ManipulationStatus::cancelled
                                                      : ManipulationStatus::failed,
         "rests");
    return result;
  }

  void tell(ManipulationStatus status, const std::string& step) {
    told_.status = status;
    told_.step = step;
    told_.time = now().count();
    told_.holds = held_ ? held_->name : std::string{};
    told_.held = {};
    told_.still_joints = still_joints_;
    if (held_ && !held_thing_.id.empty())
      told_.held = seen_as(held_thing_.id);
    put(here(component_name()), told_);
    if (held_)
      remember(*held_);
    else if (let_go_)
      remember(*let_go_, true);
    else if (exists(held_entry()))
      delete_entry(held_entry());
  }

  EntryPointer<vision::SceneObject> seen_as(const std::string& id) const {
    return EntryPointer<vision::SceneObject>{Address{vision(), id}};
  }

  // -- for a successor

  Address held_entry() const { return here(component_name() + " holds"); }

  void remember(const NamedSolid& thing, bool let_go = false) {
    const auto& x = held_thing_;
    put(held_entry(), HeldThing{seen_as(x.id), thing.name, x.colour, x.shape, thing.solid,
                                thing.pose, thing.uncertainty, thing.higher, let_go});
  }

  /// What a predecessor has taken is in the gripper. False if it did not say what that is.
  bool take_over() {
    if (!exists(held_entry())) {
      // So large that it does not press on the table where it is put down.
      held_ = {"the thing in the gripper", sphere(arm().gripper->widest), {{}, {}, "tool"}};
      const auto unknown = vision::Hypothesis{}.value;
      held_thing_ = {{}, unknown, unknown, *held_};
      return false;
    }
    const auto before = read<HeldThing>(held_entry());
    held_ = {before->name, before->solid, before->pose, before->uncertainty, before->higher};
    held_thing_ = {before->what.address.id, before->colour, before->shape, *held_};
    return true;
  }

  /// What a predecessor has let go, or was about to grasp, is where it says, and not where vision
  /// has seen it before.
  void take_over_place() {
    if (!exists(held_entry()))
      return;
    const auto before = read<HeldThing>(held_entry());
    NamedSolid thing{before->name, before->solid, before->pose, before->uncertainty,
                     before->higher};
    if (!before->let_go)
      thing.pose = geometry::compose(tool_pose(arm(), state()->positions), before->pose);
    const auto id = before->what.address.id;
    std::erase_if(things_, [&](const auto& x) { return x.id == id || x.thing.name == thing.name; });
    held_thing_ = {id, before->colour, before->shape, thing};
    things_.push_back(held_thing_);
    let_go_ = thing;
  }

  // -- looking

  /// Waits until vision has seen the table as it is. How the action ends, if it does.
  std::optional<ActionResult> look() {
    if (!state())
      return ActionResult::failed("the arm does not tell where it is");
    if (!is_at_rest()) {
      auto end = withdraw();
      if (end.outcome != ActionOutcome::succeeded)
        return end;
    }
    release_vision();
    tell(ManipulationStatus::looking, "looks at the table");
    const auto given_up = now() + look_within_.get();
    while (!has_vision_looked()) {
      if (is_to_end())
        return ActionResult::cancelled();
      if (now() > given_up)
        return ActionResult::failed("vision does not come to an end with looking at the table");
      wait();
    }
    things_ = look_at_table(placement());
    if (is_holding())
      leave_out_held(things_, held_thing_,
                     geometry::compose(tool_pose(arm(), state()->positions), held_->pose));
    placed_.correct(things_);
    let_go_.reset();
    return {};
  }

  Scene scene() const {
    auto result = scene_of(things_);
    if (held_)
      result.held = *held_;
    return result;
  }

  // -- moving

  /// Plans, and takes the time. Nothing, and the reason, if there is no plan.
  template <class F>
  std::optional<ManipulationPlan> planned(F plan) {
    tell(ManipulationStatus::planning, "plans");
    const auto begun = std::chrono::steady_clock::now();
    auto result = plan();
    told_.planning_time +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    if (auto* failure = std::get_if<MotionFailure>(&result)) {
      tell_failure(told_, *failure, things_);
      return {};
    }
    auto& found = std::get<ManipulationPlan>(result);
    told_.plans += found.motions;
    return std::move(found);
  }

  struct Carried {
    bool is_done = false;
    /// How the action ends; without it, it may be tried again.
    std::optional<ActionResult> end;
  };

  /// Carries out the plan, goes home, and looks.
  Carried carry_out_all(const ManipulationPlan& plan) {
    inhibit_vision();
    told_.reason.clear();
    told_.in_way.clear();
    told_.in_way_ids.clear();
    const auto end = stages_of(plan);
    if (end.kind == StageEnd::Kind::cancelled)
      return {false, ActionResult::cancelled(end.why)};
    if (auto over = look())
      return {false, std::move(over)};
    told_.reason = end.why;
    return {end.kind == StageEnd::Kind::done, {}};
  }

  StageEnd stages_of(const ManipulationPlan& plan) {
    double done = 0;
    for (const auto& stage : plan.stages) {
      if (action_)
        action_->progress(done++ / static_cast<double>(plan.stages.size() + 1));
      tell(stage.status, stage.text);
      if (stage.takes)
        remember(*stage.takes);
      auto end = carry_out(
        stage, [this] { return !is_to_end(); }, [this] { return is_paused_; }, [this] { wait(); });
      note_changes(stage, plan);
      if (end.kind != StageEnd::Kind::done) {
        note_joint(end.joint);
        warning("{}: {} while it {}", told_.task, end.why, stage.text);
        return end;
      }
    }
    return {};
  }

  /// What does not move any more is done without.
  void note_joint(const std::string& name) {
    const auto moving = moving_joints(arm());
    for (std::size_t i = 0; i < moving.size(); ++i)
      if (arm().joints[moving[i]].name == name &&
          watch_.did_not_follow(name, state()->positions[i])) {
        warning("the joint {} does not move any more: goes on without it", name);
        still_joints_.push_back(name);
        able_to(with_still_joint(able_, i, state()->positions[i]));
      }
  }

  /// Where it rests out of the camera's sight, or could if a joint does not move any more.
  std::vector<Configuration> postures_of_rest() {
    if (still_joints_.empty())
      return {rest()};
    auto camera = this->camera();
    std::size_t usual = 0;
    if (camera) {
      camera->pose = geometry::compose(geometry::inverse(placement(), arm_frame), camera->pose);
      usual = points_in_sight(arm(), rest(), {}, *camera);
    }
    auto result = hidden_postures(able_, scene(), rest(), camera ? &*camera : nullptr, usual);
    result.resize(std::min(result.size(), most_rests));
    return result;
  }

  /// Nothing, and the reason, if there is none.
  std::optional<ManipulationPlan> way_home(bool draws_back) {
    const auto rests = postures_of_rest();
    if (rests.empty())
      told_.reason = "its joint " + still_joints_.back() +
                     " does not move any more, and without it, it does not get out of the "
                     "camera's sight";
    for (const auto& to : rests) {
      auto plan = planned([&] {
        return planner_->go(scene(), to, joints(), state()->opening,
                            held_ ? "goes home with " + held_->name : "goes home", draws_back);
      });
      if (!plan)
        continue;
      rests_at_ = to;
      return plan;
    }
    return {};
  }

  /// What the gripper holds after a stage, and where things are that vision has not seen since.
  void note_changes(const MotionStage& stage, const ManipulationPlan& plan) {
    if (stage.status == ManipulationStatus::releasing && held_ && plan.goal && !state()->holds) {
      let_go_ = held_;
      let_go_->pose = *plan.goal;
      things_.push_back({{}, {}, {}, *let_go_});
    }
    if (state() && !state()->holds)
      held_.reset();
    else if (stage.takes) {
      held_ = stage.takes;
      placed_.forget(held_thing_.id);
      std::erase_if(things_, [&](const auto& x) { return x.thing.name == held_->name; });
    }
  }

  /// Goes where the arm rests; what stops it on the way may be over when it tries again. What
  /// nobody has seen may be beside its fingers then, or where a predecessor has left them.
  ActionResult withdraw() {
    if (!state())
      return ActionResult::failed("the arm does not tell where it is");
    for (int tries = 1; !is_at_rest(); ++tries) {
      inhibit_vision();
      // It comes to rest before it is planned from where.
      while (!state()->rests && !is_to_end())
        wait();
      const auto plan = way_home(is_resuming_ || tries > 1);
      if (!plan)
        return ActionResult::failed("the arm cannot go home: " + told_.reason);
      const auto end = stages_of(*plan);
      if (end.kind == StageEnd::Kind::cancelled)
        return ActionResult::cancelled(end.why);
      if (end.kind == StageEnd::Kind::done)
        break;
      if (tries == most_ways_home && !is_at_rest())
        return ActionResult::failed("the arm cannot go home: " + end.why);
    }
    release_vision();
    return ActionResult::succeeded();
  }

  bool is_holding() const { return held_ && state() && state()->holds; }

  bool is_at_rest() const {
    constexpr double close = 0.02; // radians
    return state() && state()->rests &&
           manipulation::distance(state()->positions, rests_at_) < close;
  }

  bool is_to_end() {
    return !is_running() || queue_.is_stopped() || (action_ && !action_->wait_while_paused());
  }

  void wait() {
    if (action_)
      action_->sleep_for(period());
    else
      sleep_for(period());
  }

  ArmActionQueue queue_;
  bool is_paused_ = false;
  /// What a predecessor has left is dealt with just now.
  bool is_resuming_ = false;
  std::optional<ManipulationPlanner> planner_;
  /// Of the last thing that could be put somewhere only with a stop between; by the planner.
  std::optional<StopsBetween> stops_between_;
  /// Of things that were asked about since the last action, by their names.
  std::map<std::string, StopsBetween> ways_;
  /// The same, where the other things are in the way.
  std::map<std::string, StopsBetween> ways_among_others_;
  /// Names of the joints that do not move any more.
  std::vector<std::string> still_joints_;
  /// The one that runs, or null.
  ActionInProgress* action_ = nullptr;
  std::vector<SeenThing> things_;
  PlacedThings placed_;
  /// In the tool's frame.
  std::optional<NamedSolid> held_;
  /// In the arm's frame; until vision has looked.
  std::optional<NamedSolid> let_go_;
  /// As it was seen before.
  SeenThing held_thing_;
  Manipulation told_;

private:
  static constexpr const char* reach_entry = "reach";
  static constexpr int most_ways_home = 3;
  /// That ways are planned to.
  static constexpr std::size_t most_rests = 6;

  /// The arm without the joints that do not move any more.
  ArmModel able_;
  Configuration rests_at_;
  JointWatch watch_;

  GraspOptions grasps_;
  spatial::ReachableTable reach_;

  Option<double> table_width_{this, "table-width", ReachMapOptions{}.width,
                              "where it is told what the arm reaches, metres"};
  Option<double> table_depth_{this, "table-depth", ReachMapOptions{}.depth,
                              "where it is told what the arm reaches, metres"};
  Option<double> spare_{this, "spare", 0.024,
                        "how much wider than a thing the gripper is opened, metres"};
  Option<double> speed_{this, "speed", 0.6, "share of the joints' speeds"};
  Option<double> acceleration_{this, "acceleration", 0.5, "share of the joints' accelerations"};
  Option<double> planning_time_{this, "planning-time", 1, "for each motion, seconds"};
  Option<std::string> algorithm_{this, "algorithm", "rrt_connect",
                                 "of motions: rrt_connect, rrt_star or bit_star"};
  Option<std::chrono::milliseconds> look_within_{
    this, "look-within", std::chrono::seconds{30},
    "it gives up if vision has not looked at the table for so long"};
};

} // namespace castor::manipulation
