#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/arm_action_queue.hpp"
#include "castor/planning/manipulation/components/commands_arm.hpp"
#include "castor/planning/manipulation/components/sees_table.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;

/// Executes the actions of an arm, one after the other: by what vision sees, and until vision sees
/// the result.
class ArmExecutor final : public SeesTable<CommandsArm> {
  void configure() override {
    CommandsArm::configure();
    ManipulationOptions options;
    options.grasps.spare = spare_;
    options.timing.speed_share = speed_;
    options.timing.acceleration_share = acceleration_;
    options.motions.time_limit = planning_time_;
    options.motions.algorithm = planning_algorithm(algorithm_.get());
    planner_.emplace(arm(), options);
  }

  void start() override {
    follow_arm();
    const auto anything =
      added<Action>().anywhere().where(field(&Action::subarchitecture) == subarchitecture());
    on_change(anything, [this](const ChangeEvent& event) { queue_.arrive(event.address); });
    execute<PickAndPlace>("the thing is in reach, and so is a free place for it",
                          [this](auto& x) { return pick_and_place(x); });
    execute<Pick>("the thing is in reach, and the gripper is empty",
                  [this](auto& x) { return pick(x); });
    execute<Place>("the gripper holds something", [this](auto& x) { return place(x); });
    execute<PushAside>("there is room beside the thing, in reach",
                       [this](auto& x) { return push_aside(x); });
    execute<GoHome>({}, [this](auto&) { return go_home(); });
    at_once<StopArm>([this] { queue_.stop(); });
    at_once<PauseArm>([this] { is_paused_ = true; });
    at_once<ResumeArm>([this] { is_paused_ = false; });
  }

  void run() override {
    take_seat();
    while (is_running() && !state())
      sleep_for(period());
    // A predecessor may have left the arm in the picture.
    if (is_running() && !is_at_rest()) {
      inhibit_vision();
      begin("go home", {});
      finish(withdraw());
    }
    while (is_running())
      wait_for_changes();
    leave_seat();
  }

  // -- actions

  template <class T, class F>
  void execute(std::string preconditions, F handler) {
    ActionOffer offer;
    offer.preconditions = std::move(preconditions);
    offer.can_pause = true;
    on_action<T>(
      [this, handler](ActionInProgress& action, const T& what) {
        if (!queue_.begin(action.address()))
          return ActionResult::cancelled("the arm was stopped");
        action_ = &action;
        auto result = handler(what);
        action_ = nullptr;
        return finish(std::move(result));
      },
      offer);
  }

  /// An action that concerns the one that runs: it has succeeded when the arm rests.
  template <class T, class F>
  void at_once(F act) {
    ActionOffer offer;
    offer.alongside = true;
    on_action<T>(
      [this, act](ActionInProgress& action, const T&) {
        act();
        const auto given_up = now() + 3s;
        while (std::is_same_v<T, StopArm> && state() && !state()->rests && now() < given_up)
          if (!action.sleep_for(period()))
            return ActionResult::cancelled();
        return ActionResult::succeeded();
      },
      offer);
  }

  ActionResult pick_and_place(const PickAndPlace& x) {
    begin("put a thing somewhere", x.what);
    return with_thing(x.what, [&](const SeenThing& thing) -> std::optional<ActionResult> {
      told_.task = "put " + thing.thing.name + ' ' + text_of(x.to);
      const auto goal = goal_of(x.to);
      if (!goal)
        return ActionResult::failed(told_.reason);
      const bool holds = held_ && state()->holds;
      auto plan = planned([&] {
        return holds
                 ? planner_->place(scene(), *goal, state()->positions)
                 : planner_->pick_and_place(scene(), thing.thing.name, *goal, state()->positions);
      });
      if (!plan)
        return ActionResult::failed(told_.reason);
      if (auto end = carry_out_all(*plan))
        return end;
      return confirmed_at(thing, plan->goal, x.to);
    });
  }

  ActionResult pick(const Pick& x) {
    begin("take a thing", x.what);
    if (state() && state()->holds)
      return ActionResult::failed("the gripper already holds " +
                                  (held_ ? held_->name : std::string("something")) +
                                  ": it has to be put down before");
    return with_thing(x.what, [&](const SeenThing& thing) -> std::optional<ActionResult> {
      told_.task = "take " + thing.thing.name;
      auto plan =
        planned([&] { return planner_->pick(scene(), thing.thing.name, state()->positions); });
      if (!plan)
        return ActionResult::failed(told_.reason);
      if (auto end = carry_out_all(*plan))
        return end;
      const auto* still_there = find_like(things_, thing, thing.thing.pose.position, near_);
      if (!still_there && state()->holds)
        return ActionResult::succeeded();
      told_.reason = still_there ? "I still see " + thing.thing.name + " where it was"
                                 : thing.thing.name + " slipped out of the gripper";
      return std::nullopt;
    });
  }

  ActionResult place(const Place& x) {
    begin("put down what the gripper holds", {});
    if (!held_ || !state() || !state()->holds)
      return ActionResult::failed("the gripper holds nothing that could be put down");
    told_.task = "put down " + held_->name + ' ' + text_of(x.to);
    if (auto end = look())
      return *end;
    const auto goal = goal_of(x.to);
    if (!goal)
      return ActionResult::failed(told_.reason);
    auto thing = held_thing_;
    auto plan = planned([&] { return planner_->place(scene(), *goal, state()->positions); });
    if (!plan)
      return ActionResult::failed(told_.reason);
    if (auto end = carry_out_all(*plan))
      return *end;
    if (auto end = confirmed_at(thing, plan->goal, x.to))
      return *end;
    return ActionResult::failed(told_.reason);
  }

  ActionResult push_aside(const PushAside& x) {
    begin("push a thing aside", x.what);
    return with_thing(x.what, [&](const SeenThing& thing) -> std::optional<ActionResult> {
      told_.task = fmt::format("push {} aside by {:.2f} m", thing.thing.name, x.distance);
      auto plan = planned(
        [&] { return planner_->push(scene(), thing.thing.name, x.distance, state()->positions); });
      if (!plan)
        return ActionResult::failed(told_.reason);
      if (auto end = carry_out_all(*plan))
        return end;
      const auto* seen = find_like(things_, thing, plan->goal->position, x.distance / 2 + near_);
      if (seen && distance_on_table(seen->thing.pose.position, thing.thing.pose.position) >=
                    x.distance - near_)
        return succeeded_at(*seen);
      told_.reason = "I do not see that " + thing.thing.name + " has moved far enough";
      return std::nullopt;
    });
  }

  ActionResult go_home() {
    begin("go home", {});
    return withdraw();
  }

  /// Tries, with the thing as it is seen before each try, until `attempt` says how the action ends.
  /// While the gripper holds the thing, it is not looked for.
  template <class F>
  ActionResult with_thing(const EntryPointer<vision::SceneObject>& what, F attempt) {
    std::optional<SeenThing> thing;
    while (true) {
      if (auto end = look())
        return *end;
      if (!(thing && held_ && state()->holds)) {
        const auto* found = find(what, thing);
        if (!found)
          return ActionResult::failed(
            thing ? "I do not see " + thing->thing.name + " any more, after this: " + told_.reason
                  : "I do not see the thing " + what.address.id + ": it is not in " + vision() +
                      ", or its place is not known");
        thing = *found;
      }
      ++told_.tries;
      if (std::optional<ActionResult> end = attempt(*thing))
        return *end;
      if (told_.tries >= tries_)
        return ActionResult::failed(told_.reason);
      info("{}: {}; trying again", told_.task, told_.reason);
    }
  }

  /// The thing, or the one that looks like it and is nearest to where it was.
  const SeenThing* find(const EntryPointer<vision::SceneObject>& what,
                        const std::optional<SeenThing>& before) {
    const auto same = std::ranges::find(things_, what.address.id, &SeenThing::id);
    if (same != things_.end() && what.address.subarchitecture == vision())
      return &*same;
    constexpr double anywhere = 10; // metres
    return before ? find_like(things_, *before, before->thing.pose.position, anywhere) : nullptr;
  }

  // -- what it says

  void begin(const std::string& task, const EntryPointer<vision::SceneObject>& what) {
    told_ = {};
    told_.task = task;
    told_.what = what;
    told_.holds = held_ ? held_->name : std::string{};
    tell(ManipulationStatus::looking, "looks at the table");
  }

  ActionResult finish(ActionResult result) {
    told_.reason = result.reason;
    told_.holds = held_ ? held_->name : std::string{};
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
    put(here(component_name()), told_);
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
    return {};
  }

  Scene scene() const {
    auto result = scene_of(things_);
    if (held_)
      result.held = *held_;
    return result;
  }

  std::string text_of(const TablePlace& x) const {
    if (x.on.address.id.empty())
      return fmt::format("at {:.2f} {:.2f}", x.x, x.y);
    const auto support = std::ranges::find(things_, x.on.address.id, &SeenThing::id);
    return "on " + (support == things_.end() ? x.on.address.id : support->thing.name);
  }

  /// Nothing, and the reason, if the place is not known.
  std::optional<PlaceGoal> goal_of(const TablePlace& x) {
    PlaceGoal result;
    result.radius = x.radius;
    if (!x.on.address.id.empty()) {
      const auto support = std::ranges::find(things_, x.on.address.id, &SeenThing::id);
      if (support == things_.end()) {
        told_.reason = "I do not see the thing " + x.on.address.id + " to put something on";
        return {};
      }
      result.bottom = support->thing.pose.position;
      result.bottom.z += half_height(support->thing.solid, support->thing.pose.rotation);
      result.support = support->thing.name;
      result.text = "the top of " + result.support;
      return result;
    }
    if (!x.frame.empty() && x.frame != geometry::table_frame) {
      told_.reason = "the place is in the frame '" + x.frame + "', and the arm knows only '" +
                     geometry::table_frame + "'";
      return {};
    }
    result.bottom =
      geometry::transform(geometry::inverse(placement(), arm_frame), Point3{x.x, x.y, 0});
    result.support = "the table";
    return result;
  }

  /// How the action ends, if vision sees the thing where it was put.
  std::optional<ActionResult> confirmed_at(const SeenThing& thing, const std::optional<Pose>& goal,
                                           const TablePlace& to) {
    const auto* seen = find_like(things_, thing, goal->position, near_);
    if (seen)
      return succeeded_at(*seen);
    // What stands on another thing may be one thing with it for vision.
    const bool is_gone = !find_like(things_, thing, thing.thing.pose.position, near_);
    if (!to.on.address.id.empty() && is_gone && !state()->holds)
      return ActionResult::succeeded({"on " + to.on.address.id});
    told_.reason = "I do not see " + thing.thing.name + " where I have put it";
    return {};
  }

  ActionResult succeeded_at(const SeenThing& seen) {
    told_.seen = EntryPointer<vision::SceneObject>{Address{vision(), seen.id}};
    return ActionResult::succeeded({"seen " + vision() + '/' + seen.id});
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
      told_.reason = failure->text;
      return {};
    }
    auto& found = std::get<ManipulationPlan>(result);
    told_.plans += found.motions;
    return std::move(found);
  }

  /// Carries out the plan, goes home, and looks. How the action ends, if it does; the reason, if it
  /// may be tried again.
  std::optional<ActionResult> carry_out_all(const ManipulationPlan& plan) {
    inhibit_vision();
    told_.reason.clear();
    auto end = stages_of(plan);
    if (end.kind == StageEnd::Kind::cancelled)
      return ActionResult::cancelled(end.why);
    const auto reason = end.kind == StageEnd::Kind::done ? std::string{} : end.why;
    if (auto over = look())
      return over;
    if (reason.empty())
      return {};
    return retried(reason);
  }

  /// Nothing happened as planned; the caller looks for the thing anew.
  std::optional<ActionResult> retried(const std::string& reason) {
    told_.reason = reason;
    return {};
  }

  StageEnd stages_of(const ManipulationPlan& plan) {
    double done = 0;
    for (const auto& stage : plan.stages) {
      if (action_)
        action_->progress(done++ / static_cast<double>(plan.stages.size() + 1));
      tell(stage.status, stage.text);
      auto end = carry_out(
        stage, [this] { return !is_to_end(); }, [this] { return is_paused_; }, [this] { wait(); });
      note_held(stage, plan);
      if (end.kind != StageEnd::Kind::done) {
        warning("{}: {} while it {}", told_.task, end.why, stage.text);
        return end;
      }
    }
    return {};
  }

  /// What the gripper holds after a stage.
  void note_held(const MotionStage& stage, const ManipulationPlan& plan) {
    if (state() && !state()->holds)
      held_.reset();
    else if (stage.status == ManipulationStatus::grasping && plan.held)
      held_ = plan.held;
  }

  /// Goes where the arm rests.
  ActionResult withdraw() {
    if (!state())
      return ActionResult::failed("the arm does not tell where it is");
    if (!is_at_rest()) {
      inhibit_vision();
      // It comes to rest before it is planned from where.
      while (!state()->rests && !is_to_end())
        wait();
      auto plan = planned([&] {
        return planner_->go(scene(), rest(), state()->positions, state()->opening,
                            held_ ? "goes home with " + held_->name : "goes home");
      });
      if (!plan)
        return ActionResult::failed("the arm cannot go home: " + told_.reason);
      const auto end = stages_of(*plan);
      if (end.kind == StageEnd::Kind::cancelled)
        return ActionResult::cancelled(end.why);
      if (end.kind != StageEnd::Kind::done && !is_at_rest())
        return ActionResult::failed("the arm cannot go home: " + end.why);
    }
    release_vision();
    return ActionResult::succeeded();
  }

  bool is_at_rest() const {
    constexpr double close = 0.02; // radians
    return state() && state()->rests && manipulation::distance(state()->positions, rest()) < close;
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

  Option<double> spare_{this, "spare", 0.024,
                        "how much wider than a thing the gripper is opened, metres"};
  Option<double> speed_{this, "speed", 0.6, "share of the joints' speeds"};
  Option<double> acceleration_{this, "acceleration", 0.5, "share of the joints' accelerations"};
  Option<double> planning_time_{this, "planning-time", 1, "for each motion, seconds"};
  Option<std::string> algorithm_{this, "algorithm", "rrt_connect",
                                 "of motions: rrt_connect, rrt_star or bit_star"};
  Option<int> tries_{this, "tries", 3, "how often an action is tried"};
  Option<double> near_{this, "near", 0.035,
                       "a thing that is seen so near to its place is there, metres"};
  Option<std::chrono::milliseconds> look_within_{
    this, "look-within", 30s, "it gives up if vision has not looked at the table for so long"};

  std::optional<ManipulationPlanner> planner_;
  ArmActionQueue queue_;
  bool is_paused_ = false;
  /// The one that runs, or null.
  ActionInProgress* action_ = nullptr;
  std::vector<SeenThing> things_;
  /// In the tool's frame.
  std::optional<NamedSolid> held_;
  /// As it was seen before.
  SeenThing held_thing_;
  Manipulation told_;
};

CASTOR_COMPONENT(ArmExecutor, "moves an arm: takes things, puts them down, pushes them aside")

} // namespace

} // namespace castor::manipulation
