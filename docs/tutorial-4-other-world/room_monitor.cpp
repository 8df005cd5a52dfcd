#include <castor/binding/binding_monitor.hpp>
#include <castor/castor.hpp>

using namespace castor::binding;

/// Tells binding of two rooms, of what is in them, and of the room that the robot is in.
class RoomMonitor : public BindingMonitor {
  void start() override {
    BindingMonitor::start();
    for (auto kind : {"room", "self", "thing"})
      declare_knowledge_of(kind);
    tell("rooms/kitchen", known({concept_of("kitchen")}));
    // What people call the other room, nobody has said yet.
    tell("rooms/other", known({concept_of("room")}));
    tell("rooms/robot", known({concept_of("self")}));
    tell("rooms/ball", known({concept_of("thing"), feature(FeatureKind::shape, "sphere"),
                              feature(FeatureKind::colour, "red")}));
    tell_in("rooms/robot", "rooms/other");
    tell_in("rooms/ball", "rooms/kitchen");
    publish();
  }

  void tell_in(const std::string& what, const std::string& room) {
    auto relation = known({feature(FeatureKind::relation_label, containment_label)});
    relation.type = ProxyType::relation;
    relation.out_ports = {{from_port, what, {}}, {to_port, room, {}}};
    tell(what + " in " + room, relation);
  }

  static Feature concept_of(const std::string& name) {
    return feature(FeatureKind::concept_name, name);
  }

  BindingProxy known(std::vector<Feature> features) const {
    features.push_back(feature(FeatureKind::temporal_frame, perceived_frame));
    features.push_back(not_from(subarchitecture()));
    BindingProxy result;
    result.features = std::move(features);
    return result;
  }
};
CASTOR_COMPONENT(RoomMonitor, "tells binding of rooms, and of what is in them")
