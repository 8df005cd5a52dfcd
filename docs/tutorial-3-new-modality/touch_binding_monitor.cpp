#include "touch.hpp"

#include <castor/castor.hpp>
#include <castor/binding/binding_monitor.hpp>

using namespace castor::binding;

/// Says of each touch: there is a thing, of that material, and it is at that place.
class TouchBindingMonitor : public BindingMonitor {
  void start() override {
    BindingMonitor::start();
    on_change(castor::added<Touch>(),
              [this](const castor::ChangeEvent& event) { tell_of(event.address); });
    for (auto& touch : read_all<Touch>())
      tell_of(touch.address);
  }

  void tell_of(const castor::Address& touch) {
    auto felt = *read<Touch>(touch);
    auto tether = tether_to({touch, std::string{castor::type_name<Touch>()}});
    auto place = "touch/place/" + touch.id;
    auto thing = "touch/thing/" + touch.id;
    tell(place, perceived({tether, location_at(felt.x, felt.y, felt.z, "table")}));
    tell(thing, perceived({tether, feature(FeatureKind::concept_name, "thing"),
                           feature(FeatureKind::material, felt.material)}));
    auto position = perceived({feature(FeatureKind::relation_label, "pos")});
    position.type = ProxyType::relation;
    position.out_ports = {{from_port, place, {}}, {to_port, thing, {}}};
    tell("touch/position/" + touch.id, position);
    publish();
  }

  BindingProxy perceived(std::vector<Feature> features) const {
    features.push_back(feature(FeatureKind::temporal_frame, perceived_frame));
    features.push_back(not_from(subarchitecture()));
    BindingProxy result;
    result.precedence = 1;
    result.features = std::move(features);
    return result;
  }
};
CASTOR_COMPONENT(TouchBindingMonitor, "tells binding of what was touched")
