#pragma once

#include "castor/actors/component/managed_component.hpp"
#include "castor/base/name_and_value.hpp"
#include "castor/binding/types.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/tabletop/table_memory.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::planning {

/// A component that knows what is on a table: what is seen now, and what it remembers.
class KnowsTable : public ManagedComponent {
protected:
  void configure() override {
    words_.clear();
    for (const auto& rule : nouns_.get()) {
      auto parts = name_and_value(rule);
      if (!parts)
        throw std::invalid_argument("the noun '" + rule +
                                    "' is not understood: write SHAPE=NOUN, such as sphere=ball");
      words_.insert_or_assign(parts->first, std::move(parts->second));
    }
    memory_ = TableMemory(agent_, words_);
  }

  /// What a predecessor knew; to be called in `start()`.
  void recall() {
    if (const auto entry = here(remembered_table); exists(entry))
      memory_.recall(*read<RememberedTable>(entry));
  }

  /// Looks at what vision, binding and spatial know now.
  void see() {
    const auto told = read_all_in<manipulation::Manipulation>(manipulation_, 1);
    if (!told.empty() && !told.front()->holds.empty())
      memory_.holds(told.front()->held.address.id);
    else if (!told.empty())
      memory_.released();
    locations_.clear();
    for (const auto& x : read_all_in<spatial::SpatialLocation>(spatial_))
      locations_[x->object.address.id] = x.address.id;
    std::vector<ThingOnTable> things;
    for (const auto& x : read_all_in<binding::BindingProxy>(binding_))
      if (auto thing = thing_of(x.address.id, *x))
        things.push_back(std::move(*thing));
    // What was let go just now nobody has seen yet.
    const auto grasped = read_all_in<manipulation::HeldThing>(manipulation_, 1);
    const bool is_let_go = !grasped.empty() && grasped.front()->let_go;
    const bool is_complete = !is_let_go && is_up_to_date();
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
  std::optional<ThingOnTable> thing_of(const std::string& id, const binding::BindingProxy& proxy) {
    const AnyEntryPointer* object = nullptr;
    bool is_thing = false;
    for (const auto& x : proxy.features) {
      is_thing = is_thing || (x.kind == binding::FeatureKind::concept_name && !x.negated);
      if (x.kind == binding::FeatureKind::source_data && x.data.points_to<vision::SceneObject>())
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
      result.height = seen->box.size.z;
      for (const auto& x : read<binding::BindingUnion>({binding_, proxy.union_id})->features)
        if (x.kind == binding::FeatureKind::extent && x.numbers.size() == 3)
          result.lengths = {x.numbers[0], x.numbers[1], x.numbers[2]};
        else if (!x.negated && x.text != "unknown")
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
    for (const auto& x : read_all_in<binding::BindingProxy>(binding_))
      if (const auto thing = thing_of(x.address.id, *x))
        objects[thing->id] = true;
    const auto scenes = read_all_in<spatial::SpatialScene>(spatial_, 1);
    if (scenes.empty() || !scenes.front()->active_components.empty())
      return false;
    const auto& known = scenes.front()->locations;
    std::size_t located = 0;
    for (const auto& x : read_all_in<spatial::SpatialLocation>(spatial_))
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
      result.push_back({thing, {std::move(x.place.relation), std::move(landmarks)}, x.is_close});
    }
    return result;
  }

  /// The SceneObject at a location.
  std::string object_at(const std::string& location) const {
    const auto found =
      std::ranges::find_if(locations_, [&](const auto& x) { return x.second == location; });
    return found == locations_.end() ? std::string{} : found->first;
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

  const std::string& vision() const { return vision_.get(); }
  const std::string& spatial() const { return spatial_.get(); }
  const std::string& manipulation() const { return manipulation_.get(); }
  std::chrono::milliseconds patience() const { return patience_; }
  /// What things are called, by their shapes.
  const std::map<std::string, std::string>& nouns() const { return words_; }

  /// The location of a SceneObject; empty if it has none.
  std::string location_of(const std::string& object) const {
    const auto found = locations_.find(object);
    return found == locations_.end() ? std::string{} : found->second;
  }

  TableMemory memory_{"robot"};

private:
  static constexpr std::chrono::milliseconds look_every{200};
  static constexpr std::pair<binding::FeatureKind, std::string_view> kinds[] = {
    {binding::FeatureKind::colour, "colour"},
    {binding::FeatureKind::shape, "shape"},
    {binding::FeatureKind::size, "size"}};

  Option<std::string> agent_{this, "agent", "robot", "name of the agent that plans"};
  Option<SubarchitectureName> vision_{this, "vision", "vision", "the subarchitecture of vision"};
  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};
  Option<SubarchitectureName> spatial_{this, "spatial", "spatial",
                                       "the subarchitecture with a TargetFinder"};
  Option<SubarchitectureName> manipulation_{this, "manipulation", "manipulation",
                                            "the subarchitecture with an ArmExecutor"};
  Option<std::vector<std::string>> nouns_{
    this, "nouns", {}, "what things are called, by their shapes: sphere=ball,cube=box"};
  Option<std::chrono::milliseconds> patience_{this, "patience", std::chrono::seconds{1},
                                              "how long it waits for spatial"};
  Option<std::chrono::milliseconds> settle_{
    this, "settle", std::chrono::seconds{5},
    "how long it waits after a step until others know what vision sees"};
  Option<std::chrono::milliseconds> forget_{
    this, "forget", std::chrono::seconds{30},
    "things that are not seen are kept for so long while others do not know all that vision sees"};

  /// As it was written last.
  RememberedTable remembered_;
  /// When others knew all that vision sees.
  Timestamp up_to_date_{0};
  std::map<std::string, std::string> words_;
  /// Locations by SceneObjects.
  std::map<std::string, std::string> locations_;
};

} // namespace castor::planning
