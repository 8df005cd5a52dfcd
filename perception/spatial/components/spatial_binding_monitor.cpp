#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/perception/spatial/camera_directions.hpp"
#include "castor/perception/spatial/scene_relations.hpp"
#include "castor/perception/spatial/types.hpp"

#include <cmath>
#include <map>
#include <string>

namespace castor::spatial {

namespace {

using binding::BindingProxy;
using binding::FeatureKind;

/// Tells binding of each location in a complete scene, of its twin that something could be brought
/// to, and of the relations between locations.
class SpatialBindingMonitor final : public binding::BindingMonitor {
  void start() override {
    BindingMonitor::start();
    on_change(changed<SpatialScene>(), [this](const ChangeEvent& event) {
      if (event.operation != Operation::remove)
        look(event.address);
    });
    for (auto& x : read_all<SpatialScene>(1))
      look(x.address);
  }

  void look(const Address& address) {
    try {
      auto scene = read<SpatialScene>(address);
      if (!scene->active_components.empty() || scene->time < last_scene_)
        return;
      last_scene_ = scene->time;
      tell_of(*scene);
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// What is not in this scene is no more.
  void tell_of(const SpatialScene& scene) {
    std::map<std::string, BindingProxy> proxies;
    const auto directions = viewing_directions(scene.viewer);
    for (auto& id : scene.locations) {
      auto location = read<SpatialLocation>(here(id));
      auto& perceived = proxies[location_id(id)];
      perceived = place(id, *location, binding::perceived_frame);
      if (directions)
        tell_view(perceived, *directions, location->box.centroid);
      proxies["spatial/desired/" + id] = place(id, *location, binding::desired_frame);
    }
    for (auto& [name, relation] : reflection_of<SpatialRelation>().enumerators)
      for (auto& x : list_of(scene, relation)) {
        std::string label{name};
        proxies["spatial/" + label + '/' + x.target + '/' + x.landmark] = relation_proxy(x, label);
      }
    for (auto& [id, known] : own_proxies())
      if (!proxies.contains(id))
        withdraw(id);
    for (auto& [id, proxy] : proxies)
      tell(id, std::move(proxy));
    publish();
  }

  BindingProxy place(const std::string& id, const SpatialLocation& x, const char* frame) const {
    auto& centre = x.box.centroid;
    BindingProxy result;
    result.features = {feature(FeatureKind::temporal_frame, frame),
                       binding::not_from(subarchitecture()),
                       binding::tether_to({here(id), std::string{type_name<SpatialLocation>()}}),
                       binding::location_at(centre.x, centre.y, centre.z, x.box.frame)};
    return result;
  }

  /// So that "the leftmost thing" is left of others for whoever sees them.
  static void tell_view(BindingProxy& proxy, const GroundDirections& directions,
                        const geometry::Point3& centre) {
    constexpr double same_place = 1e-4; // metres
    const GroundPoint point{centre.x, centre.y};
    const auto seen = as_seen(directions, point);
    if (std::hypot(seen.x - point.x, seen.y - point.y) > same_place)
      proxy.features.push_back(binding::seen_at(seen.x, seen.y, centre.z));
  }

  BindingProxy relation_proxy(const SpatialRelationship& x, const std::string& label) const {
    BindingProxy result;
    result.type = binding::ProxyType::relation;
    result.features = {feature(FeatureKind::temporal_frame, binding::perceived_frame),
                       binding::not_from(subarchitecture()),
                       feature(FeatureKind::relation_label, label)};
    result.out_ports = {{binding::from_port, location_id(x.target), {}},
                        {binding::to_port, location_id(x.landmark), {}}};
    return result;
  }

  static std::string location_id(const std::string& id) { return "spatial/location/" + id; }

  std::int64_t last_scene_ = 0;
};

CASTOR_COMPONENT(SpatialBindingMonitor, "adds locations and spatial relations to binding")

} // namespace

} // namespace castor::spatial
