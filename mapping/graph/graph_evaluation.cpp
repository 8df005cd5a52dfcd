#include "castor/mapping/graph/graph_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

namespace castor::mapping {

namespace {

double median(std::vector<double> x) {
  if (x.empty())
    return 0;
  std::ranges::sort(x);
  return x[x.size() / 2];
}

/// Sum of the largest counts of each group, over all.
template <class Counts>
double share_of_largest(const Counts& counts, std::size_t all) {
  std::size_t sum = 0;
  for (auto& [group, members] : counts)
    sum += std::ranges::max_element(members, {}, [](auto& x) { return x.second; })->second;
  return all == 0 ? 0 : static_cast<double>(sum) / static_cast<double>(all);
}

} // namespace

GraphQuality evaluate(const std::vector<GraphNode>& nodes,
                      const std::function<std::string(const Point2&)>& room_at,
                      const std::vector<TrueDoor>& doors, double near) {
  GraphQuality result;
  std::map<std::string, std::map<std::int64_t, std::size_t>> by_room;
  std::map<std::int64_t, std::map<std::string, std::size_t>> by_area;
  std::set<std::size_t> found;
  std::vector<double> errors;
  std::vector<double> width_errors;
  for (auto& x : nodes) {
    const Point2 at{x.pose.x, x.pose.y};
    if (x.kind == NodeKind::place) {
      ++result.places;
      ++by_room[room_at(at)][x.area];
      ++by_area[x.area][room_at(at)];
      continue;
    }
    auto door =
      std::ranges::min_element(doors, {}, [&](auto& y) { return distance(y.middle, at); });
    const auto index = static_cast<std::size_t>(door - doors.begin());
    // A second gateway in one door is invented.
    if (door == doors.end() || distance(door->middle, at) > near || !found.insert(index).second) {
      result.doors_invented.push_back(at);
      continue;
    }
    errors.push_back(distance(door->middle, at));
    width_errors.push_back(std::abs(door->width - x.width));
  }
  result.rooms = by_room.size();
  result.areas = by_area.size();
  result.area_recall = share_of_largest(by_room, result.places);
  result.area_precision = share_of_largest(by_area, result.places);
  result.doors_found = found.size();
  for (std::size_t i = 0; i < doors.size(); ++i) {
    const bool counts = doors[i].is_open && doors[i].was_seen;
    result.doors_seen += counts || found.contains(i) ? 1 : 0;
    if (counts && !found.contains(i))
      result.doors_missed.push_back(doors[i].name);
  }
  result.door_error_median = median(errors);
  result.door_error_most = errors.empty() ? 0 : std::ranges::max(errors);
  result.width_error_median = median(width_errors);
  return result;
}

} // namespace castor::mapping
