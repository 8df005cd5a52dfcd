#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/tabletop/components/finds_places.hpp"
#include "castor/planning/tabletop/goal_text.hpp"
#include "castor/planning/tabletop/refusals.hpp"
#include "castor/planning/tabletop/table_memory.hpp"
#include "castor/planning/tabletop/types.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;

/// Makes goals of requests about things on a table, says what is known of it, and executes the
/// steps of plans by an arm: a contributor and an executor of continual planning.
class TableExecutor final : public FindsPlaces {
  void start() override {
    recall();
    on_call<StateRequest>([this](const StateRequest& request) {
      see();
      return memory_.state(request.goal, places(parts_in(request.goal)));
    });
    on_call<TableGoalRequest>([this](const TableGoalRequest& request) { return goal(request); });
    on_action<PlannedAction>([this](ActionInProgress& action, const PlannedAction& step) {
      auto result = act(action, step);
      remember();
      if (result.outcome == ActionOutcome::succeeded) {
        refusals_.clear();
      } else if (result.outcome == ActionOutcome::failed) {
        if (refusals_.empty())
          refusals_.push_back({result.reason});
        const auto why = explanation_of(refusals_);
        if (!step.name.starts_with("reposition-") && step.arguments.size() > 1)
          memory_.refused(step.arguments[1], why.in_way_ids);
        const auto told = read_all_in<manipulation::Manipulation>(manipulation(), 1);
        const auto reason =
          told.empty() ? why.reason : with_joints(why.reason, told.front()->still_joints);
        put(here(table_problem), TableProblem{with_words(reason, nouns()),
                                              with_words(why.help, nouns()), memory_.has_moved()});
      }
      return result;
    });
  }

  // -- goals

  TableGoalReply goal(const TableGoalRequest& request) {
    const auto& step = request.step;
    see();
    if (asks_about_history(step.action)) {
      auto answer = answer_about_history(step, memory_.things({}), memory_.history());
      return {std::move(answer.words), {}, {}, {}, std::move(answer.things)};
    }
    std::set<std::string> parts;
    for (const auto& place : step.places)
      if (place.landmarks.empty() && is_seen_part(place.relation))
        parts.insert(place.relation);
    const auto things = memory_.things(places({parts.begin(), parts.end()}));
    auto goal = goal_of(step, things, reach_of(things), exchange(), landing());
    if (request.begins && (goal.wish == TableWish::keep || goal.wish == TableWish::keep_clear ||
                           goal.wish == TableWish::allow)) {
      memory_.keep(goal);
      remember();
      return {goal.words, {}, {}, {}, std::move(goal.things)};
    }
    if (request.begins && goal.wish == TableWish::note) {
      memory_.note_places();
      remember();
    }
    if (goal.wish != TableWish::goal)
      return {goal.words, {}, {}, {}, std::move(goal.things), goal.wish == TableWish::refusal};
    auto reached =
      request.begins ? memory_.begin(goal, request.because) : AchieveGoal{goal.formula};
    if (request.begins) {
      remember();
      refusals_.clear();
      put(here(table_problem), TableProblem{});
    }
    return {{},
            std::move(reached),
            std::move(goal.words),
            std::move(goal.result),
            std::move(goal.things)};
  }

  // -- steps of plans

  ActionResult act(ActionInProgress& action, const PlannedAction& step) {
    const auto& x = step.arguments;
    try {
      if (step.name.starts_with("reposition-")) {
        memory_.choose(step.name, {x.begin() + 1, x.end()});
        return ActionResult::succeeded();
      }
      see();
      auto result = act_on_thing(action, step);
      // People may ask at once what it holds.
      if (result.outcome == ActionOutcome::cancelled)
        see();
      return result;
    } catch (const CallException& e) {
      warning("{}", e.what());
      return ActionResult::failed("nobody tells me now where there is a place for it");
    }
  }

  ActionResult act_on_thing(ActionInProgress& action, const PlannedAction& step) {
    const auto& x = step.arguments;
    const auto* thing = memory_.thing(x.at(1));
    if (thing == nullptr)
      return ActionResult::failed("it is not seen any more");
    const EntryPointer<vision::SceneObject> what{Address{vision(), thing->seen.id}};
    if (step.name == "move")
      return move(action, *thing, what, x.at(2));
    if (step.name == "take")
      return take(action, thing->name, what);
    if (step.name == "push")
      return push(action, thing->name, what);
    warning("there is no step '{}' for an arm", step.name);
    return ActionResult::failed("I do not know how to do that");
  }

  // Names are copies: what is remembered may change while the arm moves.

  ActionResult take(ActionInProgress& action, std::string name,
                    const EntryPointer<vision::SceneObject>& what) {
    auto result = done(action, manipulation::Pick{what});
    if (result.outcome == ActionOutcome::succeeded)
      memory_.taken(name);
    return settled(action, std::move(result));
  }

  ActionResult push(ActionInProgress& action, std::string name,
                    const EntryPointer<vision::SceneObject>& what) {
    manipulation::PushAside push;
    push.what = what;
    if (memory_.push_distance() > 0)
      push.distance = memory_.push_distance();
    auto result = done(action, push);
    if (result.outcome == ActionOutcome::succeeded)
      memory_.pushed(name);
    return settled(action, std::move(result));
  }

  /// Straight to a waypoint. Nothing if there is no way to push it there.
  std::optional<ActionResult> push_to(ActionInProgress& action, const TableMemory::Thing& thing,
                                      const EntryPointer<vision::SceneObject>& what,
                                      const std::string& waypoint) {
    const auto* to = memory_.place(waypoint);
    if (to == nullptr || thing.is_held || !memory_.is_pushed_to(waypoint))
      return std::nullopt;
    const auto name = thing.name;
    const auto place = *to;
    manipulation::PushAside push;
    push.what = what;
    push.x = place.x - thing.seen.place.x;
    push.y = place.y - thing.seen.place.y;
    push.distance = std::hypot(push.x, push.y);
    auto result = done(action, push);
    if (result.outcome == ActionOutcome::failed && !has_tried()) {
      // It can still be carried there.
      refusals_.pop_back();
      return std::nullopt;
    }
    if (result.outcome == ActionOutcome::succeeded) {
      const auto id = seen_as(result);
      manipulation::TablePlace wanted;
      wanted.x = place.x;
      wanted.y = place.y;
      memory_.moved(name, waypoint, id, place_of(id, wanted));
    }
    return settled(action, std::move(result));
  }

  /// Where the best place is not possible for the arm, the next ones are tried.
  ActionResult move(ActionInProgress& action, const TableMemory::Thing& thing,
                    EntryPointer<vision::SceneObject> what, const std::string& waypoint) {
    if (auto pushed = push_to(action, thing, what, waypoint))
      return *pushed;
    const auto name = thing.name;
    const auto wanted = memory_.chosen(waypoint);
    std::string reason;
    const auto targets = targets_of(thing, waypoint, reason);
    ActionResult result = ActionResult::failed(reason);
    std::vector<manipulation::PickAndPlace> ways;
    for (const auto& x : targets) {
      ways.push_back({what, x.to});
      if (x.takes_stop)
        ways.push_back({what, x.to, true});
    }
    // Only where there is no place that it can be put at directly.
    for (const auto& x : targets)
      if (!x.takes_stop)
        ways.push_back({what, x.to, true});
    bool is_moved = false;
    for (auto& way : ways) {
      const auto& to = way.to;
      if (is_moved && way.may_put_between)
        continue;
      way.what = what;
      memory_.carries(name);
      result = done(action, way);
      // Where the arm has tried it, another place is no better.
      if (result.outcome == ActionOutcome::failed && !has_tried())
        continue;
      if (result.outcome != ActionOutcome::succeeded)
        break;
      is_moved = true;
      const auto id = seen_as(result);
      memory_.moved(name, waypoint, id, place_of(id, to));
      result = settled(action, std::move(result));
      const auto* moved = memory_.thing(name);
      if (id.empty() || moved == nullptr || is_there(moved->seen.id, wanted))
        return result;
      what = EntryPointer<vision::SceneObject>{Address{vision(), moved->seen.id}};
      result = ActionResult::failed("I have put it down, but do not see it where it was to be");
      refusals_.push_back({result.reason});
    }
    return settled(action, std::move(result));
  }

  /// Of "seen vision/ID"; empty if it is not seen.
  static std::string seen_as(const ActionResult& result) {
    constexpr std::string_view seen = "seen ";
    std::string id;
    for (const auto& x : result.became_true)
      if (x.starts_with(seen))
        id = x.substr(x.rfind('/') + 1);
    return id;
  }

  template <class T>
  ActionResult done(ActionInProgress& action, T what) {
    const auto asked = perform(manipulation(), std::move(what));
    if (!action.wait_until([&asked] { return asked.is_over(); })) {
      asked.cancel();
      const auto end = asked.wait(safe_end_.get());
      return ActionResult::cancelled(end.reason);
    }
    const auto end = asked.state();
    if (end.outcome == ActionOutcome::failed)
      refuse(end.reason);
    return {end.outcome, end.reason, end.became_true, end.became_false};
  }

  /// Whether the arm had a plan for its last action.
  bool has_tried() {
    const auto told = read_all_in<manipulation::Manipulation>(manipulation(), 1);
    return !told.empty() && told.front()->plans > 0;
  }

  /// The arm has not done something, and says what is in its way.
  void refuse(const std::string& reason) {
    Refusal refusal{reason};
    if (const auto told = read_all_in<manipulation::Manipulation>(manipulation(), 1);
        !told.empty() && told.front()->reason == reason) {
      refusal.in_way = told.front()->in_way;
      refusal.in_way_ids = told.front()->in_way_ids;
    }
    refusals_.push_back(std::move(refusal));
  }

  Option<std::chrono::milliseconds> safe_end_{this, "safe-end", 10s,
                                              "how long it waits for a cancelled action to end"};

  /// Why steps of the goal were not possible since the last one that was.
  std::vector<Refusal> refusals_;
};

CASTOR_COMPONENT(TableExecutor, "makes goals of requests about things on a table, and has an arm "
                                "do the steps of plans for them")

} // namespace

} // namespace castor::planning
