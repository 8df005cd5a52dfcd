#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace castor::planning {

namespace {

using binding::BindingProxy;
using binding::FeatureKind;

/// Tells binding of things that a TableExecutor remembers and vision does not see, so that people
/// can speak of them: what the arm holds, and what stands on another thing where vision sees one.
/// Tells vision what things of a stack are, of which it sees a part.
class HiddenThings final : public binding::BindingMonitor {
  void start() override {
    BindingMonitor::start();
    on_change(changed<RememberedTable>(), [this](const ChangeEvent&) { look(); });
    on_change(deleted<vision::SceneObject>().in(vision_), [this](const ChangeEvent&) { look(); });
    for (const auto& [id, proxy] : own_proxies())
      told_.insert(id);
    for (const auto& x : read_all<vision::PartlySeen>())
      partly_seen_.emplace(x.address.id, *x);
    look();
  }

  void look() {
    std::set<std::string> before = std::exchange(told_, {});
    auto gripper = from_here();
    gripper.features.push_back(feature(FeatureKind::concept_name, "gripper"));
    tell_all(gripper_id, std::move(gripper));
    for (const auto& table : read_all<RememberedTable>(1))
      for (const auto& x : table->things)
        if (x.is_held || !x.on.empty())
          tell_of(x, *table);
    for (const auto& id : before)
      if (!told_.contains(id))
        withdraw(id);
    publish();
    std::map<std::string, vision::PartlySeen> parts;
    for (const auto& table : read_all<RememberedTable>(1))
      parts = seen_in_part(*table);
    for (const auto& [id, x] : partly_seen_)
      if (!parts.contains(id))
        delete_entry(here(id));
    for (const auto& [id, x] : parts)
      if (const auto known = partly_seen_.find(id);
          known == partly_seen_.end() || known->second != x)
        put(here(id), x);
    partly_seen_ = std::move(parts);
  }

  /// The things that stand on others, and these, by ids of entries.
  static std::map<std::string, vision::PartlySeen> seen_in_part(const RememberedTable& table) {
    std::map<std::string, vision::PartlySeen> result;
    for (const auto& x : table.things) {
      const bool is_loaded =
        std::ranges::find(table.things, x.name, &RememberedThing::on) != table.things.end();
      if (x.is_held || (x.on.empty() && !is_loaded) || x.id.empty())
        continue;
      vision::PartlySeen whole{x.id, {}, {}, {}, x.lengths};
      for (const auto& quality : x.qualities)
        (quality.kind == "colour"  ? whole.colour
         : quality.kind == "shape" ? whole.shape
                                   : whole.size) = quality.value;
      result.emplace(vision::partly_seen(x.id), std::move(whole));
    }
    return result;
  }

  void tell_of(const RememberedThing& x, const RememberedTable& table) {
    auto id = x.proxy;
    if (x.id.empty() || !exists(Address{vision_.get(), x.id})) {
      id = hidden_proxy(x.name);
      auto thing = from_here();
      thing.features.push_back(feature(FeatureKind::concept_name, "thing"));
      for (const auto& quality : x.qualities)
        for (const auto& [name, kind] : kinds)
          if (quality.kind == name)
            thing.features.push_back(feature(kind, quality.value));
      if (const auto& size = x.lengths; size.z > 0)
        thing.features.push_back(binding::extent_of(size.x, size.y, size.z));
      tell_all(id, std::move(thing));
    }
    // Vision may not have looked since it was taken.
    if (x.is_held)
      return relate(id, binding::containment_label, gripper_id);
    const auto below = std::ranges::find(table.things, x.on, &RememberedThing::name);
    if (below != table.things.end())
      relate(id, "on", below->proxy);
  }

  void relate(const std::string& from, const std::string& label, const std::string& to) {
    auto relation = from_here();
    relation.type = binding::ProxyType::relation;
    relation.features.push_back(feature(FeatureKind::relation_label, label));
    relation.out_ports = {{binding::from_port, from, {}}, {binding::to_port, to, {}}};
    tell_all(label + " of " + from, std::move(relation));
  }

  void tell_all(const std::string& id, BindingProxy proxy) {
    told_.insert(id);
    tell(id, std::move(proxy));
  }

  BindingProxy from_here() const {
    BindingProxy result;
    result.features = {feature(FeatureKind::temporal_frame, binding::perceived_frame),
                       binding::not_from(subarchitecture()), binding::not_from(vision_.get())};
    return result;
  }

  static constexpr const char* gripper_id = "table/gripper";
  static constexpr std::pair<const char*, FeatureKind> kinds[] = {
    {"colour", FeatureKind::colour}, {"shape", FeatureKind::shape}, {"size", FeatureKind::size}};

  Option<SubarchitectureName> vision_{this, "vision", "vision", "the subarchitecture of vision"};

  /// Proxies that binding knows.
  std::set<std::string> told_;
  /// The entries that are here, by their ids.
  std::map<std::string, vision::PartlySeen> partly_seen_;
};

CASTOR_COMPONENT(HiddenThings, "tells binding of things that are remembered but not seen")

} // namespace

} // namespace castor::planning
