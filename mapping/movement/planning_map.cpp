#include "castor/mapping/movement/planning_map.hpp"

namespace castor::mapping {

void PlanningMap::update(const CellMap& map, std::uint64_t version) {
  if (version_ == version)
    return;
  version_ = version;
  cells_ = map;
  clearance_ = ClearanceMap(cells_, options_);
  if (!options_.unknown_is_obstacle)
    return;
  auto occupied = options_;
  occupied.unknown_is_obstacle = false;
  of_occupied_ = ClearanceMap(cells_, occupied);
}

} // namespace castor::mapping
