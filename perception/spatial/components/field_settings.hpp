#pragma once

#include "castor/actors/component/component.hpp"
#include "castor/perception/spatial/potential_fields.hpp"

namespace castor::spatial {

/// The options of a component that uses potential fields.
class FieldSettings {
public:
  explicit FieldSettings(Component* owner)
    : map_size_{owner, "map-size", FieldOptions{}.map_size, "side of the map, metres"},
      cell_size_{owner, "cell-size", FieldOptions{}.cell_size, "of the map, metres"},
      distractor_radius_{owner, "distractor-radius", FieldOptions{}.distractor_radius,
                         "another object this close disturbs, metres"} {}

  FieldOptions options() const {
    FieldOptions result;
    result.map_size = map_size_;
    result.cell_size = cell_size_;
    result.distractor_radius = distractor_radius_;
    return result;
  }

private:
  Option<double> map_size_;
  Option<double> cell_size_;
  Option<double> distractor_radius_;
};

} // namespace castor::spatial
