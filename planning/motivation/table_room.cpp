#include "castor/planning/motivation/table_room.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace castor::planning {

TableSpot spot_for(const TableThing& thing, const TablePoint& at) {
  return {"spot-of-" + thing.object, at.x, at.y};
}

TableRoom::TableRoom(std::span<const TableThing> table, TableReach reach, TableLanding landing)
  : table_(table), reach_(std::move(reach)),
    landings_(std::make_shared<TableLandings>(std::move(landing))) {
  // nop
}

bool TableRoom::can_be_put(const TableThing& thing, const TablePoint& at) const {
  return reach_(thing, at.x, at.y) != spatial::Reach::none;
}

std::optional<double> TableRoom::effort(const TableThing& thing, const TablePoint& at) const {
  if (std::abs(at.x) + thing.radius > table_half_width ||
      std::abs(at.y) + thing.radius > table_half_depth || landings_->is_beyond(thing, {at.x, at.y}))
    return std::nullopt;
  return effort_of(reach_(thing, at.x, at.y));
}

double TableRoom::room_around(const TablePoint& at, const TableThing& thing,
                              std::initializer_list<const TableThing*> left_out) const {
  double result = std::numeric_limits<double>::infinity();
  for (const auto& other : table_)
    if (!other.is_held && other.object != thing.object && other.on != thing.object &&
        std::ranges::find(left_out, &other) == left_out.end())
      result = std::min(result, distance(at, place_of(other)) - other.radius - thing.radius);
  return result;
}

} // namespace castor::planning
