#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/base/name_and_value.hpp"
#include "castor/binding/types.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/tabletop/table_memory.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;
using binding::BindingProxy;
using binding::BindingUnion;
using binding::FeatureKind;
using communication::DirectivePlace;
using spatial::GroundPoint;
using spatial::SpatialLocation;
using spatial::WantedPlace;

/// Makes goals of requests about things on a table, says what is known of it, and executes the
/// steps of plans by an arm: a contributor and an executor of continual planning.
class TableExecutor final : public ManagedComponent {
  void configure() override {
    std::map<std::string, std::string> nouns;
    for (const auto& rule : nouns_.get()) {
      auto parts = name_and_value(rule);
      if (!parts)
        throw std::invalid_argument("the noun '" + rule +
                                    "' is not understood: write SHAPE=NOUN, such as sphere=ball");
      nouns.insert_or_assign(parts->first, std::move(parts->second));
    }
    memory_ = TableMemory(agent_, std::move(nouns));
  }

  void start() override {
    if (const auto entry = here(remembered_table); exists(entry))
      memory_.recall(*read<RememberedTable>(entry));
    on_call<StateRequest>([this](const StateRequest& request) {
      see();
      return memory_.state(request.goal, places(parts_in(request.goal)));
    });
    on_call<TableGoalRequest>([this](const TableGoalRequest& request) { return goal(request); });
    on_action<PlannedAction>([this](ActionInProgress& action, const PlannedAction& step) {
      auto result = act(action, step);
      remember();
      if (result.outcome == ActionOutcome::failed)
        put(here(table_problem), TableProblem{result.reason});
      return result;
    });
  }

  // -- what there is

  /// Looks at what vision, binding and spatial know now.
  void see() {
    const auto told = read_all_in<manipulation::Manipulation>(manipulation_, 1);
    if (!told.empty() && !told.front()->holds.empty())
      memory_.holds(told.front()->held.address.id);
    else if (!told.empty())
      memory_.released();
    locations_.clear();
    for (const auto& x : read_all_in<SpatialLocation>(spatial_))
      locations_[x->object.address.id] = x.address.id;
    std::vector<ThingOnTable> things;
    for (const auto& x : read_all_in<BindingProxy>(binding_))
      if (auto thing = thing_of(x.address.id, *x))
        things.push_back(std::move(*thing));
    const bool is_complete = is_up_to_date();
    if (is_complete)
      up_to_date_ = now();
    memory_.see(things, is_complete || now() - up_to_date_ > forget_.get());
    remember();
  }

  /// For a successor.
  void remember() {
    auto known = memory_.remembered();
    if (remembered_ == known)
      return;
    put(here(remembered_table), known);
    remembered_ = std::move(known);
  }

  /// Nothing for proxies of something else, such as places.
  std::optional<ThingOnTable> thing_of(const std::string& id, const BindingProxy& proxy) {
    const AnyEntryPointer* object = nullptr;
    bool is_thing = false;
    for (const auto& x : proxy.features) {
      is_thing = is_thing || (x.kind == FeatureKind::concept_name && !x.negated);
      if (x.kind == FeatureKind::source_data && x.data.points_to<vision::SceneObject>())
        object = &x.data;
    }
    if (object == nullptr || !is_thing || proxy.union_id.empty())
      return std::nullopt;
    try {
      const auto seen = read<vision::SceneObject>(object->address);
      ThingOnTable result;
      result.id = object->address.id;
      result.proxy = id;
      result.place = {seen->box.centroid.x, seen->box.centroid.y};
      result.radius = std::hypot(seen->box.size.x, seen->box.size.y) / 2 / std::sqrt(2.0);
      for (const auto& x : read<BindingUnion>({binding_, proxy.union_id})->features)
        if (!x.negated && x.text != "unknown")
          for (const auto& [kind, name] : kinds)
            if (x.kind == kind)
              result.qualities.emplace(name, x.text);
      return result;
    } catch (const DoesNotExistOnWM&) {
      return std::nullopt;
    }
  }

  /// Whether spatial and binding know all that vision sees.
  bool is_up_to_date() {
    std::map<std::string, bool> objects;
    for (const auto& x : read_all_in<vision::SceneObject>(vision_))
      objects[x.address.id] = false;
    for (const auto& x : read_all_in<BindingProxy>(binding_))
      if (const auto thing = thing_of(x.address.id, *x))
        objects[thing->id] = true;
    const auto scenes = read_all_in<spatial::SpatialScene>(spatial_, 1);
    if (scenes.empty() || !scenes.front()->active_components.empty())
      return false;
    const auto& known = scenes.front()->locations;
    std::size_t located = 0;
    for (const auto& x : read_all_in<SpatialLocation>(spatial_))
      if (objects.contains(x->object.address.id) &&
          std::ranges::find(known, x.address.id) != known.end())
        ++located;
    return located == objects.size() && known.size() == objects.size() &&
           std::ranges::all_of(objects, [](const auto& x) { return x.second; });
  }

  std::vector<ThingAtPlace> places(std::vector<std::string> parts) {
    std::vector<ThingAtPlace> result;
    spatial::HeldPlacesQuery query;
    query.parts = std::move(parts);
    for (auto& x : call<spatial::HeldPlacesQuery, spatial::HeldPlacesQuery>(
                     spatial_, query, {.timeout = patience_.get()})
                     .held) {
      const auto thing = object_at(x.thing);
      std::vector<std::string> landmarks;
      for (const auto& id : x.place.landmarks)
        landmarks.push_back(object_at(id));
      result.push_back({thing, {std::move(x.place.relation), std::move(landmarks)}});
    }
    return result;
  }

  /// The SceneObject at a location.
  std::string object_at(const std::string& location) const {
    const auto found =
      std::ranges::find_if(locations_, [&](const auto& x) { return x.second == location; });
    return found == locations_.end() ? std::string{} : found->first;
  }

  // -- goals

  TableGoalReply goal(const TableGoalRequest& request) {
    const auto& step = request.step;
    see();
    std::string formula;
    for (const auto& place : step.places)
      if (place.landmarks.empty())
        formula += "(in-part x " + place.relation + ')';
    const auto things = memory_.things(places(parts_in(formula)));
    auto goal = goal_of(step, things);
    if (goal.wish != TableWish::goal)
      return {goal.words, {}, {}, {}};
    auto reached = request.begins ? memory_.begin(goal) : AchieveGoal{goal.formula};
    if (request.begins) {
      remember();
      put(here(table_problem), TableProblem{});
    }
    return {{}, std::move(reached), std::move(goal.words), std::move(goal.result)};
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
      const auto* thing = memory_.thing(x.at(1));
      if (thing == nullptr)
        return ActionResult::failed("it is not seen any more");
      const EntryPointer<vision::SceneObject> what{Address{vision_, thing->seen.id}};
      if (step.name == "move")
        return move(action, *thing, what, x.at(2));
      if (step.name == "take")
        return take(action, thing->name, what);
      if (step.name == "push")
        return push(action, thing->name, what);
    } catch (const CallException& e) {
      return ActionResult::failed(e.what());
    }
    return ActionResult::failed("there is no step '" + step.name + "' for an arm");
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
    auto result = done(action, push);
    if (result.outcome == ActionOutcome::succeeded)
      memory_.pushed(name);
    return settled(action, std::move(result));
  }

  /// Where the best place is not possible for the arm, the next ones are tried.
  ActionResult move(ActionInProgress& action, const TableMemory::Thing& thing,
                    const EntryPointer<vision::SceneObject>& what, const std::string& waypoint) {
    const auto name = thing.name;
    std::string reason;
    const auto targets = targets_of(thing, waypoint, reason);
    ActionResult result = ActionResult::failed(reason);
    for (const auto& to : targets) {
      manipulation::PickAndPlace wanted;
      wanted.what = what;
      wanted.to = to;
      result = done(action, wanted);
      if (result.outcome != ActionOutcome::failed)
        break;
    }
    if (result.outcome != ActionOutcome::succeeded)
      return settled(action, std::move(result));
    // "seen vision/ID"
    constexpr std::string_view seen = "seen ";
    std::string id;
    for (const auto& x : result.became_true)
      if (x.starts_with(seen))
        id = x.substr(x.rfind('/') + 1);
    memory_.moved(name, waypoint, id, place_of(id, targets.front()));
    return settled(action, std::move(result));
  }

  /// Where it is seen, or was to be put.
  GroundPoint place_of(const std::string& id, const manipulation::TablePlace& wanted) {
    const auto& on = wanted.on.address.id;
    for (const auto& x : {id, on})
      try {
        if (!x.empty()) {
          const auto& at = read<vision::SceneObject>({vision_, x})->box.centroid;
          return {at.x, at.y};
        }
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
      }
    return {wanted.x, wanted.y};
  }

  /// @param reason becomes that why there are none
  std::vector<manipulation::TablePlace>
  targets_of(const TableMemory::Thing& thing, const std::string& waypoint, std::string& reason) {
    const auto wanted = memory_.chosen(waypoint);
    if (wanted.empty()) {
      const auto* place = memory_.place(waypoint);
      if (place == nullptr) {
        reason = "the place " + waypoint + " is not known any more";
        return {};
      }
      return {table_place(*place)};
    }
    spatial::PlacementQuery query;
    if (const auto at = locations_.find(thing.seen.id); at != locations_.end() && !thing.is_held)
      query.thing = at->second;
    query.radius = thing.seen.radius;
    query.requested_targets = static_cast<std::uint32_t>(places_.get());
    for (const auto& x : wanted) {
      auto& place = query.places.emplace_back(WantedPlace{x.relation, {}});
      for (const auto& landmark : x.landmarks) {
        const auto* other = memory_.thing(landmark);
        const auto at = other == nullptr ? locations_.end() : locations_.find(other->seen.id);
        if (at == locations_.end()) {
          reason = "what it is to be put there for is not seen any more";
          return {};
        }
        place.landmarks.push_back(at->second);
      }
    }
    query = call<spatial::PlacementQuery, spatial::PlacementQuery>(spatial_, query,
                                                                   {.timeout = patience_.get()});
    reason = query.reason;
    std::vector<manipulation::TablePlace> result;
    if (!query.on.empty()) {
      manipulation::TablePlace on;
      on.on = EntryPointer<vision::SceneObject>{Address{vision_, object_at(query.on)}};
      return {on};
    }
    for (const auto& x : query.targets)
      result.push_back(table_place(x.position));
    return result;
  }

  static manipulation::TablePlace table_place(const GroundPoint& at) {
    manipulation::TablePlace result;
    result.x = at.x;
    result.y = at.y;
    return result;
  }

  template <class T>
  ActionResult done(ActionInProgress& action, T what) {
    const auto asked = perform(manipulation_, std::move(what));
    if (!action.wait_until([&asked] { return asked.is_over(); })) {
      asked.cancel();
      const auto end = asked.wait(safe_end_.get());
      return ActionResult::cancelled(end.reason);
    }
    const auto end = asked.state();
    return {end.outcome, end.reason, end.became_true, end.became_false};
  }

  /// When others know what vision sees now.
  ActionResult settled(ActionInProgress& action, ActionResult result) {
    const auto given_up = now() + settle_.get();
    while (!is_up_to_date() && now() < given_up)
      if (!action.sleep_for(look_every))
        break;
    see();
    return result;
  }

  static constexpr auto look_every = 200ms;
  static constexpr std::pair<FeatureKind, std::string_view> kinds[] = {
    {FeatureKind::colour, "colour"}, {FeatureKind::shape, "shape"}, {FeatureKind::size, "size"}};

  Option<std::string> agent_{this, "agent", "robot", "name of the agent that plans"};
  Option<SubarchitectureName> vision_{this, "vision", "vision", "the subarchitecture of vision"};
  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};
  Option<SubarchitectureName> spatial_{this, "spatial", "spatial",
                                       "the subarchitecture with a TargetFinder"};
  Option<SubarchitectureName> manipulation_{this, "manipulation", "manipulation",
                                            "the subarchitecture with an ArmExecutor"};
  Option<std::vector<std::string>> nouns_{
    this, "nouns", {}, "what things are called, by their shapes: sphere=ball,cube=box"};
  Option<std::int64_t> places_{this, "places", 3, "places that are tried for a step"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 1s,
                                              "how long it waits for spatial"};
  Option<std::chrono::milliseconds> settle_{
    this, "settle", 5s, "how long it waits after a step until others know what vision sees"};
  Option<std::chrono::milliseconds> safe_end_{this, "safe-end", 10s,
                                              "how long it waits for a cancelled action to end"};

  Option<std::chrono::milliseconds> forget_{
    this, "forget", 30s,
    "things that are not seen are kept for so long while others do not know all that vision sees"};

  TableMemory memory_{"robot"};
  /// As it was written last.
  RememberedTable remembered_;
  /// When others knew all that vision sees.
  Timestamp up_to_date_{0};
  /// Locations by SceneObjects.
  std::map<std::string, std::string> locations_;
};

CASTOR_COMPONENT(TableExecutor, "makes goals of requests about things on a table, and has an arm "
                                "do the steps of plans for them")

} // namespace

} // namespace castor::planning
