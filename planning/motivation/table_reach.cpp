#include "castor/planning/motivation/table_reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace castor::planning {

namespace {

using spatial::Reach;

Reach reach_on(const spatial::ReachQuery& told, std::size_t thing, double x, double y) {
  const double column = std::floor((x - told.low.x) / told.step);
  const double row = std::floor((y - told.low.y) / told.step);
  if (!(column >= 0 && row >= 0 && column < told.columns && row < told.rows))
    return Reach::none;
  return told.things[thing].squares.at(static_cast<std::size_t>(row) * told.columns +
                                       static_cast<std::size_t>(column));
}

} // namespace

Reach reach_in_box(const TableThing&, double x, double y) {
  constexpr double half_width = 0.26;
  constexpr double half_depth = 0.18;
  if (std::abs(x) <= half_width && std::abs(y) <= half_depth)
    return Reach::direct;
  return std::abs(x) <= table_half_width && std::abs(y) <= table_half_depth ? Reach::perhaps
                                                                            : Reach::none;
}

TableReach reach_told(spatial::ReachQuery told, std::vector<std::string> objects) {
  return [told = std::move(told), objects = std::move(objects)](const TableThing& thing, double x,
                                                                double y) {
    const auto found = std::ranges::find(objects, thing.object);
    const auto index = static_cast<std::size_t>(found - objects.begin());
    if (index >= told.things.size() || told.things[index].squares.empty())
      return reach_in_box(thing, x, y);
    return reach_on(told, index, x, y);
  };
}

std::optional<double> effort_of(Reach reach) {
  switch (reach) {
    case Reach::direct:
      return 0;
    case Reach::by_stop:
      return 0.3;
    case Reach::perhaps:
      return 1;
    case Reach::none:
      break;
  }
  return std::nullopt;
}

} // namespace castor::planning
