#include "castor/planning/tabletop/things_in_way.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

namespace {

/// A thing may be moved so often for another one.
constexpr int most_moves = 2;

} // namespace

void ThingsInWay::refused(const std::string& thing, std::vector<std::string> in_way) {
  const auto does_not_help = [&](const std::string& x) {
    const auto moved = moved_for_.find({thing, x});
    return x == thing || in_way_.contains(x) ||
           (moved != moved_for_.end() && moved->second >= most_moves);
  };
  if (!in_way.empty() && std::ranges::none_of(in_way, does_not_help))
    in_way_[thing] = std::move(in_way);
}

void ThingsInWay::moved(const std::string& thing) {
  std::erase_if(in_way_, [&](const auto& x) {
    const bool is_in_way = std::ranges::find(x.second, thing) != x.second.end();
    if (is_in_way)
      ++moved_for_[{x.first, thing}];
    return is_in_way || x.first == thing;
  });
}

void ThingsInWay::clear() {
  in_way_.clear();
  moved_for_.clear();
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
