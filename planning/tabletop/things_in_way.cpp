#include "castor/planning/tabletop/things_in_way.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

void ThingsInWay::refused(const std::string& thing, std::vector<std::string> in_way) {
  const auto comes_after = [&](const std::string& x) { return x == thing || in_way_.contains(x); };
  if (!in_way.empty() && std::ranges::none_of(in_way, comes_after))
    in_way_[thing] = std::move(in_way);
}

void ThingsInWay::moved(const std::string& thing) {
  std::erase_if(in_way_, [&](const auto& x) {
    return x.first == thing || std::ranges::find(x.second, thing) != x.second.end();
  });
}

std::vector<std::string>
ThingsInWay::facts(const std::function<bool(const std::string&)>& is_movable) const {
  std::vector<std::string> result;
  for (const auto& [thing, others] : in_way_)
    if (std::ranges::all_of(others, is_movable))
      for (const auto& x : others)
        result.push_back("(in-way " + x + ' ' + thing + ')');
  return result;
}

} // namespace castor::planning
