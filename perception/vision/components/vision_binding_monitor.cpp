#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/mapping/geometry/boxes.hpp"
#include "castor/perception/vision/types.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::vision {

namespace {

using binding::BindingProxy;
using binding::BindingUnion;
using binding::Feature;
using binding::FeatureKind;

/// Tells binding of each object on the table: the thing, where it is, and that it is there. What
/// others say of the same thing vision is to learn.
class VisionBindingMonitor final : public binding::BindingMonitor {
  void start() override {
    BindingMonitor::start();
    declare_knowledge_of("thing");
    on_change(changed<SceneObject>(), [this](const ChangeEvent& event) {
      look(event.address);
      publish();
    });
    if (!memory_->empty())
      on_change(changed<PartlySeen>().in(memory_), [this](const ChangeEvent& event) {
        remember(event);
        publish();
      });
    on_binding_change(changed<BindingUnion>(), [this](const ChangeEvent& event) {
      if (event.operation != Operation::remove)
        learn_from(event.address);
    });
    for (auto& [id, proxy] : own_proxies())
      if (id.starts_with(object_prefix))
        objects_[id.substr(object_prefix.size())];
    for (auto& x : read_all<SceneObject>())
      objects_[x.address.id];
    if (!memory_->empty())
      for (auto& x : read_all_in<PartlySeen>(memory_))
        remembered_[x->object_id] = *x;
    // A copy: those that are not there any more are forgotten.
    for (const auto& [id, place] : std::map(objects_))
      look(here(id));
    publish();
  }

  void look(const Address& address) {
    try {
      tell_of(address.id, as_remembered(address.id, *read<SceneObject>(address)));
    } catch (const DoesNotExistOnWM&) {
      forget(address.id);
    }
  }

  void remember(const ChangeEvent& event) {
    std::string id;
    if (event.operation == Operation::remove) {
      const auto known = std::ranges::find_if(
        remembered_, [&](const auto& x) { return partly_seen(x.first) == event.address.id; });
      if (known == remembered_.end())
        return;
      id = known->first;
      remembered_.erase(known);
    } else
      try {
        auto whole = *read<PartlySeen>(event.address);
        id = whole.object_id;
        remembered_[id] = std::move(whole);
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
        return;
      }
    look(here(id));
  }

  /// What is seen of a thing that something stands on is a part of it.
  SceneObject as_remembered(const std::string& id, SceneObject object) const {
    const auto found = remembered_.find(id);
    if (found == remembered_.end())
      return object;
    const auto& whole = found->second;
    for (const auto& [word, known] : {std::pair{&object.colour, &whole.colour},
                                      {&object.shape, &whole.shape},
                                      {&object.size, &whole.size}})
      if (!known->empty())
        *word = {*known, 1};
    if (whole.lengths != Point3{})
      object.lengths = whole.lengths;
    return object;
  }

  void tell_of(const std::string& id, const SceneObject& object) {
    auto& [place, lengths] = objects_[id];
    // A thing that is jostled is where it was, and as large.
    if (geometry::has_moved(place, object.box) || geometry::is_refined(place, object.box)) {
      place = object.box;
      lengths = object.lengths;
    } else if (lengths == Point3{})
      lengths = object.lengths;
    auto data = AnyEntryPointer{here(id), std::string{type_name<SceneObject>()}};
    auto thing = from_here();
    thing.features.push_back(binding::tether_to(data));
    thing.features.push_back(feature(FeatureKind::concept_name, "thing"));
    add_word(thing, FeatureKind::colour, object.colour);
    add_word(thing, FeatureKind::shape, object.shape);
    add_word(thing, FeatureKind::size, object.size);
    // Those who ask for sizes want to compare them.
    const auto& size = lengths == Point3{} ? place.size : lengths;
    if (is_told(object.size) && size.x > 0)
      thing.features.push_back(binding::extent_of(size.x, size.y, size.z));
    auto location = from_here();
    auto& centre = place.centroid;
    location.features.push_back(binding::tether_to(data));
    location.features.push_back(binding::location_at(centre.x, centre.y, centre.z, place.frame));
    auto position = from_here();
    position.type = binding::ProxyType::relation;
    position.features.push_back(feature(FeatureKind::relation_label, binding::position_label));
    position.out_ports = {{binding::from_port, location_id(id), {}},
                          {binding::to_port, object_id(id), {}}};
    tell(object_id(id), std::move(thing));
    tell(location_id(id), std::move(location));
    tell(position_id(id), std::move(position));
  }

  void forget(const std::string& id) {
    objects_.erase(id);
    withdraw(position_id(id));
    withdraw(object_id(id));
    withdraw(location_id(id));
  }

  // -- what others say

  void learn_from(const Address& address) {
    try {
      auto bound = read<BindingUnion>(address);
      for (auto& proxy : bound->proxy_ids)
        if (proxy.starts_with(object_prefix) && bound->proxy_ids.size() > 1)
          learn(proxy.substr(object_prefix.size()),
                read<BindingProxy>({binding(), proxy})->features, bound->features);
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// The words for colours and shapes that somebody else has said and vision has not.
  void learn(const std::string& id, const std::vector<Feature>& own,
             const std::vector<Feature>& all) {
    LearnInstruction instruction{true, id, {}};
    std::string words;
    for (auto& x : all)
      if (!x.negated && (x.kind == FeatureKind::colour || x.kind == FeatureKind::shape) &&
          std::ranges::find(own, x) == own.end()) {
        instruction.attributes.push_back(
          {x.kind == FeatureKind::colour ? "colour" : "shape", {x.text, 1}});
        words += ' ' + x.text;
      }
    if (instruction.attributes.empty())
      return;
    try {
      add(here("learn" + words + " from " + id), std::move(instruction), {.only_once = true});
    } catch (const AlreadyExistsOnWM&) {
      trace("{}: the instruction to learn{} was given before", id, words);
    }
  }

  BindingProxy from_here() const {
    BindingProxy result;
    result.features = {feature(FeatureKind::temporal_frame, binding::perceived_frame),
                       binding::not_from(subarchitecture())};
    return result;
  }

  bool is_told(const Hypothesis& word) const {
    return word.confidence >= certain_ && word.value != "unknown";
  }

  void add_word(BindingProxy& to, FeatureKind kind, const Hypothesis& word) const {
    if (!is_told(word))
      return;
    to.features.push_back(word.confidence < sure_
                            ? binding::uncertain_feature(kind, word.value, word.confidence)
                            : feature(kind, word.value));
  }

  static constexpr std::string_view object_prefix = "vision/object/";
  static std::string object_id(const std::string& id) { return std::string{object_prefix} + id; }
  static std::string location_id(const std::string& id) { return "vision/location/" + id; }
  static std::string position_id(const std::string& id) { return "vision/position/" + id; }

  Option<double> certain_{this, "certain", 0.5,
                          "least confidence of a colour, a shape or a size that is added"};

  Option<double> sure_{this, "sure", 0.8,
                       "below this confidence, a colour, a shape or a size is told as uncertain"};

  Option<SubarchitectureName> memory_{
    this, "memory", "",
    "the subarchitecture that remembers things which are seen in part; empty if there is none"};

  struct Told {
    AlignedBox place;
    Point3 lengths;
  };

  /// Where each was, and how large, when that was last told.
  std::map<std::string, Told> objects_;
  /// By ids of SceneObjects.
  std::map<std::string, PartlySeen> remembered_;
};

CASTOR_COMPONENT(VisionBindingMonitor, "adds the objects on the table to binding")

} // namespace

} // namespace castor::vision
