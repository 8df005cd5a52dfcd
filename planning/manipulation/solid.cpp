#include "castor/planning/manipulation/solid.hpp"

#include "castor/mapping/geometry/poses.hpp"

namespace castor::manipulation {

PlacedSolid highest(const NamedSolid& thing) {
  PlacedSolid result{thing.solid, thing.pose};
  result.solid.size.z += thing.higher;
  result.pose.position = geometry::transform(thing.pose, Point3{0, 0, thing.higher / 2});
  return result;
}

} // namespace castor::manipulation
