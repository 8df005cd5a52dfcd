#include "castor/planning/motivation/table_landings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace castor::planning {

namespace {

using spatial::Reach;

/// An arm tries places around the one that it is told: where that is in vain, it is not asked for
/// places so near, metres.
constexpr double beside = 0.02;
/// Where stops on the way were looked for in vain, it is not asked for places so near, metres.
constexpr double beside_no_stop = 0.04;
constexpr double same = 1e-6;

/// Places that an arm is asked for at most.
constexpr std::size_t most_direct = 120;
constexpr std::size_t most_between = 12;

double gap(const spatial::GroundPoint& a, const spatial::GroundPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

} // namespace

void TableLandings::begin(bool may_put_between) {
  may_put_between_ = may_put_between;
  asked_ = 0;
}

const TableLandings::Said* TableLandings::said_of(const TableThing& thing,
                                                  const spatial::GroundPoint& at) const {
  for (const auto& x : said_) {
    const double near = x.reach != Reach::none ? same
                        : x.has_looked_between ? beside_no_stop
                                               : beside;
    const bool is_all = x.reach != Reach::none || x.has_looked_between || !may_put_between_;
    if (is_all && x.thing->object == thing.object && gap(x.at, at) < near)
      return &x;
  }
  return nullptr;
}

bool TableLandings::is_beyond(const TableThing& thing, const spatial::GroundPoint& at) const {
  const auto* said = said_of(thing, at);
  return said != nullptr &&
         (said->reach == Reach::none || (said->reach == Reach::by_stop && !may_put_between_));
}

bool TableLandings::lands(const TableThing& thing, const spatial::GroundPoint& at) {
  if (!ask_)
    return true;
  if (said_of(thing, at) == nullptr) {
    if (++asked_ > (may_put_between_ ? most_between : most_direct))
      return false;
    const auto reach = ask_(thing, {at}, may_put_between_);
    if (reach.empty())
      return true;
    said_.push_back({&thing, at, reach.front(), may_put_between_});
  }
  return !is_beyond(thing, at);
}

std::optional<spatial::GroundPoint>
TableLandings::first_of(const TableThing& thing,
                        const std::vector<spatial::GroundPoint>& points) const {
  if (!ask_ || points.empty())
    return std::nullopt;
  for (const bool may_put_between : {false, true}) {
    const auto reach = ask_(thing, points, may_put_between);
    for (std::size_t i = 0; i < std::min(reach.size(), points.size()); ++i)
      if (reach[i] != Reach::none)
        return points[i];
  }
  return std::nullopt;
}

const TableThing* TableLandings::most_often_beyond() const {
  std::map<const TableThing*, std::size_t> counts;
  for (const auto& x : said_)
    if (x.reach == Reach::none)
      ++counts[x.thing];
  const auto most = std::ranges::max_element(counts, {}, [](const auto& x) { return x.second; });
  return most == counts.end() ? nullptr : most->first;
}

} // namespace castor::planning
