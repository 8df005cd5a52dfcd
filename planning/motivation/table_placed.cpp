#include "castor/planning/motivation/table_placed.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

namespace {

/// Whether all things can be put at their places one after the other: each when those have left
/// that stand there now.
/// @param waits_for for each, indices of others
bool have_order(std::vector<std::vector<std::size_t>> waits_for) {
  for (std::size_t left = waits_for.size(); left > 0;) {
    const auto next = std::ranges::find_if(waits_for, &std::vector<std::size_t>::empty);
    if (next == waits_for.end())
      return false;
    const auto moved = static_cast<std::size_t>(next - waits_for.begin());
    // It has to wait for itself from now on, so that it is not found again.
    *next = {moved};
    for (std::size_t i = 0; i < waits_for.size(); ++i)
      if (i != moved)
        std::erase(waits_for[i], moved);
    --left;
  }
  return true;
}

} // namespace

TablePlaced::TablePlaced(std::vector<TablePoint> places, const Things& things,
                         const TableRoom& room, Things left_out)
  : things_(things), room_(room), left_out_(std::move(left_out)), at_(std::move(places)) {
  // nop
}

std::optional<double> TablePlaced::effort() const {
  constexpr double of_each = 0.1;
  double result = 0;
  std::vector<std::vector<std::size_t>> waits_for(things_.size());
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (!is_apart(i))
      return std::nullopt;
    if (stays(i))
      continue;
    const auto there = room_.effort(*things_[i], at_[i]);
    if (!there || !is_free_of_others(i))
      return std::nullopt;
    result += of_each + distance(at_[i], place_of(*things_[i])) + *there;
    for (std::size_t j = 0; j < things_.size(); ++j)
      if (j != i && !stays(j) && is_too_near(i, place_of(*things_[j]), *things_[j]))
        waits_for[i].push_back(j);
  }
  return have_order(std::move(waits_for)) ? std::optional{result} : std::nullopt;
}

bool TablePlaced::land() const {
  auto& landings = room_.landings();
  const auto all = [&](auto can_be_put) {
    for (std::size_t i = 0; i < things_.size(); ++i)
      if (!stays(i) && !can_be_put(*things_[i], spatial::GroundPoint{at_[i].x, at_[i].y}))
        return false;
    return true;
  };
  // What is known takes no time.
  return all([&](const auto& thing, const auto& at) { return !landings.is_beyond(thing, at); }) &&
         all([&](const auto& thing, const auto& at) { return landings.lands(thing, at); });
}

std::vector<TableSpot> TablePlaced::spots() const {
  std::vector<TableSpot> result;
  for (std::size_t i = 0; i < things_.size(); ++i)
    result.push_back(spot_for(*things_[i], at_[i]));
  return result;
}

bool TablePlaced::stays(std::size_t i) const {
  return distance(at_[i], place_of(*things_[i])) < stands_right;
}

bool TablePlaced::is_too_near(std::size_t i, const TablePoint& at, const TableThing& other) const {
  constexpr double rounding = 1e-6;
  return gap_between(*things_[i], at_[i], other, at) < finger_gap - rounding;
}

/// From where the things before it are to be.
bool TablePlaced::is_apart(std::size_t i) const {
  for (std::size_t j = 0; j < i; ++j)
    if (is_too_near(i, at_[j], *things_[j]) && !(stays(i) && stays(j)))
      return false;
  return true;
}

/// From what is not moved.
bool TablePlaced::is_free_of_others(std::size_t i) const {
  return std::ranges::none_of(room_.things(), [&](const TableThing& x) {
    return !x.is_held && std::ranges::find(things_, &x) == things_.end() &&
           std::ranges::find(left_out_, &x) == left_out_.end() && is_too_near(i, place_of(x), x);
  });
}

} // namespace castor::planning
