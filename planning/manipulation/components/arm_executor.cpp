#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/components/resumes_manipulation.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
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
class ArmExecutor final : public ResumesManipulation {
  void start() override {
    follow_arm();
    const auto anything =
      added<Action>().anywhere().where(field(&Action::subarchitecture) == subarchitecture());
    on_change(anything, [this](const ChangeEvent& event) { queue_.arrive(event.address); });
    at_once<StopArm>(true, [this] {
      queue_.stop();
      halt();
    });
    at_once<PauseArm>(true, [this] {
      is_paused_ = true;
      halt();
    });
    at_once<ResumeArm>(false, [this] { is_paused_ = false; });
  }

  /// When it is known what a predecessor has left.
  void offer_actions() {
    execute<PickAndPlace>("the thing is in reach, and so is a free place for it",
                          [this](auto& x) { return pick_and_place(x); });
    execute<Pick>("the thing is in reach, and the gripper is empty",
                  [this](auto& x) { return pick(x); });
    execute<Place>("the gripper holds something", [this](auto& x) { return place(x); });
    execute<PushAside>("there is room beside the thing, in reach",
                       [this](auto& x) { return push_aside(x); });
    execute<GoHome>({}, [this](auto&) { return go_home(); });
    on_call<ExchangeQuery>([this](const ExchangeQuery& x) { return exchanged(x); });
    on_call<LandingQuery>([this](const LandingQuery& x) { return landed(x); });
  }

  void run() override {
    take_seat();
    tell_reach();
    const auto given_up = now() + arm_within_.get();
    while (is_running() && !state() && now() < given_up)
      sleep_for(period());
    if (state())
      resume();
    offer_actions();
    while (is_running()) {
      if (state() && !is_resumed())
        resume();
      if (is_resumed())
        wait_for_changes();
      else
        wait_for_changes(look_for_arm);
    }
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
        if (is_resuming_)
          return ActionResult::failed("the arm has been down, and has to go home first");
        action_ = &action;
        auto result = handler(what);
        action_ = nullptr;
        return finish(std::move(result));
      },
      offer);
  }

  // -- questions

  ExchangeQuery exchanged(ExchangeQuery query) {
    if (!is_at_rest() || held_ || action_ != nullptr)
      return query;
    auto things = look_at_table(placement());
    placed_.correct(things);
    const auto thing = std::ranges::find(things, query.what.address.id, &SeenThing::id);
    const auto other = std::ranges::find(things, query.at.address.id, &SeenThing::id);
    if (thing == things.end() || other == things.end() || thing == other)
      return query;
    PlaceGoal goal;
    goal.bottom = other->thing.pose.position;
    goal.bottom.z = 0;
    goal.radius = TablePlace{}.radius;
    goal.support = "the table";
    auto& ways = ways_of(*thing, things);
    query.is_known = true;
    if (planner_->landing_of(ways.ways_from_here(), goal) || ways.reach(goal))
      return query;
    const auto taken = planner_->pick(scene_of({*thing}), thing->thing.name, joints());
    const auto* failure = std::get_if<MotionFailure>(&taken);
    query.reason = failure != nullptr
                     ? failure->text
                     : "the arm cannot turn its gripper so that it puts it down there";
    return query;
  }

  LandingQuery landed(LandingQuery query) {
    query.reach.clear();
    if (!is_at_rest() || held_ || action_ != nullptr)
      return query;
    auto things = look_at_table(placement());
    placed_.correct(things);
    const auto thing = std::ranges::find(things, query.what.address.id, &SeenThing::id);
    if (thing == things.end())
      return query;
    auto& ways = ways_of(*thing, things);
    const auto to_arm = geometry::inverse(placement(), arm_frame);
    for (const auto& point : query.points) {
      PlaceGoal goal;
      goal.bottom = geometry::transform(to_arm, Point3{point.x, point.y, 0});
      goal.radius = TablePlace{}.radius;
      goal.support = "the table";
      const bool is_direct = planner_->landing_of(ways.ways_from_here(), goal).has_value();
      // The stops are made before anything else is moved.
      const auto is_by_stop = [&] {
        return ways.reach(goal) && ways_of(*thing, things, false).reach(goal);
      };
      query.reach.push_back(is_direct                               ? spatial::Reach::direct
                            : query.may_put_between && is_by_stop() ? spatial::Reach::by_stop
                                                                    : spatial::Reach::none);
    }
    return query;
  }

  /// Where the thing can be put down on its way; where it is now is free then.
  static std::vector<Point3> free_places_but_for(const SeenThing& thing,
                                                 std::vector<SeenThing> things) {
    std::erase_if(things, [&](const SeenThing& x) { return x.thing.name == thing.thing.name; });
    return free_places(things, thing.thing.solid.size.x, true);
  }

  /// With the places between that are free now.
  /// @param is_alone as if the thing were alone on the table
  StopsBetween& ways_of(const SeenThing& thing, const std::vector<SeenThing>& things,
                        bool is_alone = true) {
    const auto name = thing.thing.name;
    const auto scene = is_alone ? scene_of({thing}) : scene_of(things);
    auto& all_ways = is_alone ? ways_ : ways_among_others_;
    const auto free = free_places_but_for(thing, things);
    if (const auto known = all_ways.find(name);
        known != all_ways.end() && !known->second.are_for(scene, name, joints()))
      all_ways.erase(known);
    return all_ways.try_emplace(name, *planner_, scene, name, free, joints()).first->second;
  }

  /// An action that concerns the one that runs.
  /// @param stands_then whether it has succeeded when the arm rests
  template <class T, class F>
  void at_once(bool stands_then, F act) {
    ActionOffer offer;
    offer.alongside = true;
    on_action<T>(
      [this, act, stands_then](ActionInProgress& action, const T&) {
        act();
        // What is on its way to the arm and back comes first.
        bool goes_on = action.sleep_for(2 * period());
        const auto given_up = now() + 3s;
        while (goes_on && stands_then && state() && !state()->rests && now() < given_up)
          goes_on = action.sleep_for(period());
        return goes_on ? ActionResult::succeeded() : ActionResult::cancelled();
      },
      offer);
  }

  ActionResult pick_and_place(const PickAndPlace& x) {
    begin("put a thing somewhere", x.what);
    int most_between = x.may_put_between ? 4 : 0;
    return with_thing(x.what, [&](const SeenThing& thing) -> std::optional<ActionResult> {
      told_.task = "put " + thing.thing.name + ' ' + text_of(x.to);
      const auto goal = goal_of(x.to);
      if (!goal)
        return ActionResult::failed(told_.reason);
      const bool holds = held_ && state()->holds;
      auto plan = holds
                    ? planned([&] { return planner_->place(scene(), *goal, joints()); })
                    : planned_to_take(thing, [&](const Scene& scene) {
                        return planner_->pick_and_place(scene, thing.thing.name, *goal, joints());
                      });
      if (!plan && holds)
        return grasped_anew();
      if (!plan && most_between-- > 0)
        return put_between(thing, *goal);
      if (!plan)
        return ActionResult::failed(told_.reason);
      if (const auto carried = carry_out_all(*plan); !carried.is_done)
        return carried.end;
      return confirmed_at(thing, *plan->goal, *goal, x.to);
    });
  }

  /// As far as the thing may be larger than it is seen, it may be in the arm's way itself: then it
  /// is taken to be as it is seen.
  template <class F>
  std::optional<ManipulationPlan> planned_to_take(const SeenThing& thing, F plan) {
    auto found = planned([&] { return plan(scene()); });
    if (found || told_.in_way != std::vector{thing.thing.name})
      return found;
    auto as_seen = scene();
    for (auto& x : as_seen.things)
      if (x.name == thing.thing.name)
        x.higher = x.uncertainty = 0;
    return planned([&] { return plan(as_seen); });
  }

  /// To be tried again from there.
  std::optional<ActionResult> put_between(const SeenThing& thing, const PlaceGoal& goal) {
    const auto reason = told_.reason;
    const auto& name = thing.thing.name;
    if (!stops_between_ || !stops_between_->are_for(scene(), name, joints()))
      stops_between_.emplace(*planner_, scene(), name, free_places_but_for(thing, things_),
                             joints());
    const auto plan = stops_between_->plan_to(goal);
    if (!plan)
      return ActionResult::failed(reason);
    told_.plans += plan->motions;
    const auto carried = carry_out_all(*plan);
    if (carried.is_done) {
      told_.reason = "it has to be held in another way";
      // That was none.
      --told_.tries;
    }
    return carried.end;
  }

  /// What is held in such a way that it cannot be put there is put down, to be tried again.
  std::optional<ActionResult> grasped_anew() {
    const auto reason = told_.reason;
    const auto end = put_down_anywhere();
    told_.reason = reason;
    if (end.outcome == ActionOutcome::succeeded)
      return std::nullopt;
    return end.outcome == ActionOutcome::cancelled ? end : ActionResult::failed(reason);
  }

  ActionResult pick(const Pick& x) {
    begin("take a thing", x.what);
    if (is_holding())
      return ActionResult::failed("the gripper already holds " + held_->name +
                                  ": it has to be put down before");
    return with_thing(x.what, [&](const SeenThing& thing) -> std::optional<ActionResult> {
      told_.task = "take " + thing.thing.name;
      auto plan = planned_to_take(thing, [&](const Scene& scene) {
        return planner_->pick(scene, thing.thing.name, joints());
      });
      if (!plan)
        return ActionResult::failed(told_.reason);
      if (const auto carried = carry_out_all(*plan); !carried.is_done)
        return carried.end;
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
    if (!is_holding())
      return ActionResult::failed("the gripper holds nothing that could be put down");
    told_.task = "put down " + held_->name + ' ' + text_of(x.to);
    if (auto end = look())
      return *end;
    const auto goal = goal_of(x.to);
    if (!goal)
      return ActionResult::failed(told_.reason);
    auto thing = held_thing_;
    auto plan = planned([&] { return planner_->place(scene(), *goal, joints()); });
    if (!plan)
      return ActionResult::failed(told_.reason);
    if (const auto carried = carry_out_all(*plan); !carried.is_done)
      return carried.end.value_or(ActionResult::failed(told_.reason));
    if (auto end = confirmed_at(thing, *plan->goal, *goal, x.to))
      return *end;
    return ActionResult::failed(told_.reason);
  }

  ActionResult push_aside(const PushAside& x) {
    begin("push a thing aside", x.what);
    return with_thing(x.what, [&](const SeenThing& thing) -> std::optional<ActionResult> {
      told_.task = fmt::format("push {} aside by {:.2f} m", thing.thing.name, x.distance);
      const auto goal = push_goal(x, thing);
      auto plan =
        planned([&] { return planner_->push(scene(), thing.thing.name, goal, joints()); });
      if (!plan)
        return ActionResult::failed(told_.reason);
      if (const auto carried = carry_out_all(*plan); !carried.is_done)
        return carried.end;
      const auto* seen = find_like(things_, thing, plan->goal->position, x.distance / 2 + near_);
      if (seen && distance_on_table(seen->thing.pose.position, thing.thing.pose.position) >=
                    x.distance - near_)
        return succeeded_at(*seen);
      told_.reason = "I do not see that " + thing.thing.name + " has moved far enough";
      return std::nullopt;
    });
  }

  PushGoal push_goal(const PushAside& x, const SeenThing& thing) const {
    PushGoal result{x.distance};
    if (const double length = std::hypot(x.x, x.y); length > 0) {
      const auto to_arm = geometry::inverse(placement(), arm_frame);
      const auto along = geometry::rotate(to_arm.rotation, {x.x / length, x.y / length, 0});
      result.along = Point3{along.x, along.y, 0};
    }
    const double radius = thing.thing.solid.size.x / 2;
    result.may_end_at = [this, radius](const Point3& at) {
      return is_within_reach(geometry::transform(placement(), at), radius);
    };
    return result;
  }

  ActionResult go_home() {
    begin("go home", {});
    trust_joints();
    return withdraw();
  }

  /// Tries, with the thing as it is seen before each try, until `attempt` says how the action ends.
  /// While the gripper holds the thing, it is not looked for.
  template <class F>
  ActionResult with_thing(const EntryPointer<vision::SceneObject>& what, F attempt) {
    std::optional<SeenThing> thing;
    if (is_holding()) {
      if (held_thing_.id != what.address.id)
        return ActionResult::failed("the gripper holds " + held_->name +
                                    ": it has to be put down before");
      thing = held_thing_;
    }
    while (true) {
      if (auto end = look())
        return *end;
      if (!thing || !is_holding()) {
        const auto* found = find(what, thing);
        if (!found)
          return ActionResult::failed(
            thing ? "I do not see " + thing->thing.name + " any more, after this: " + told_.reason
                  : "I do not see it any more, or do not know where it is");
        thing = *found;
        held_thing_ = *found;
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

  std::string text_of(const TablePlace& x) const {
    if (x.on.address.id.empty())
      return fmt::format("at {:.2f} {:.2f}", x.x, x.y);
    const auto support = std::ranges::find(things_, x.on.address.id, &SeenThing::id);
    return "on " + (support == things_.end() ? "another thing" : support->thing.name);
  }

  /// Nothing, and the reason, if the place is not known.
  std::optional<PlaceGoal> goal_of(const TablePlace& x) {
    PlaceGoal result;
    result.radius = x.radius;
    if (!x.on.address.id.empty()) {
      const auto support = std::ranges::find(things_, x.on.address.id, &SeenThing::id);
      if (support == things_.end()) {
        told_.reason = "I do not see any more what it is to be put on";
        return {};
      }
      result.bottom = support->thing.pose.position;
      result.bottom.z += half_height(support->thing.solid, support->thing.pose.rotation) -
                         placed_.fall_of(support->id);
      result.support = support->thing.name;
      result.text = "the top of " + result.support;
      return result;
    }
    if (!x.frame.empty() && x.frame != geometry::table_frame) {
      warning("the place is in the frame '{}', and the arm knows only '{}'", x.frame,
              geometry::table_frame);
      told_.reason = "I do not know where that place is";
      return {};
    }
    result.bottom =
      geometry::transform(geometry::inverse(placement(), arm_frame), Point3{x.x, x.y, 0});
    result.support = "the table";
    return result;
  }

  /// How the action ends, if vision sees the thing where it was put.
  /// @param pose where it was let go, for that goal
  std::optional<ActionResult> confirmed_at(const SeenThing& thing, const Pose& pose,
                                           const PlaceGoal& goal, const TablePlace& to) {
    const double off = to.on.address.id.empty() ? 0 : seen_off(pose.position.z);
    const auto* seen = find_like(things_, thing, pose.position, near_ + off);
    if (seen) {
      const double bottom = pose.position.z - half_height(thing.thing.solid, pose.rotation);
      placed_.put(seen->id, thing, pose, bottom - goal.bottom.z);
      return succeeded_at(*seen);
    }
    // What stands on another thing may be one thing with it for vision.
    const bool is_gone = !find_like(things_, thing, thing.thing.pose.position, near_);
    if (!to.on.address.id.empty() && is_gone && !state()->holds)
      return ActionResult::succeeded({"on " + to.on.address.id});
    told_.reason = "I do not see " + thing.thing.name + " where I have put it";
    return {};
  }

  ActionResult succeeded_at(const SeenThing& seen) {
    told_.seen = seen_as(seen.id);
    return ActionResult::succeeded({"seen " + vision() + '/' + seen.id});
  }

  static constexpr auto look_for_arm = 500ms;

  Option<std::chrono::milliseconds> arm_within_{
    this, "arm-within", 10s, "it fails what it is asked for if the arm has not told for so long"};
  Option<int> tries_{this, "tries", 3, "how often an action is tried"};
  Option<double> near_{this, "near", 0.035,
                       "a thing that is seen so near to its place is there, metres"};
};

CASTOR_COMPONENT(ArmExecutor, "moves an arm: takes things, puts them down, pushes them aside")

} // namespace

} // namespace castor::manipulation
