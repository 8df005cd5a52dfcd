#include "castor/mapping/movement/followed_person.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

bool FollowedPerson::is_steady(const SeenPerson& x) const {
  if (x.speed < options_.walking)
    return false;
  return !steady_ || (x.speed > steady_->speed / 2 &&
                      std::abs(normalised(x.heading - steady_->heading)) < options_.turn);
}

Point2 FollowedPerson::expected(const SeenPerson& x, std::int64_t then) const {
  // Nobody walks on for ever.
  constexpr double longest = 3; // seconds
  const double way = x.speed * std::min(static_cast<double>(time_ - then) * 1e-6, longest);
  return {x.place.x + way * std::cos(x.heading), x.place.y + way * std::sin(x.heading)};
}

FollowedPerson::People::iterator FollowedPerson::find_successor(People people) const {
  constexpr std::int64_t at_once = 300'000; // microseconds
  if (!steady_ || time_ - steady_time_ < at_once)
    return people.end();
  const auto place = expected(*steady_, steady_time_);
  return std::ranges::find_if(people, [&](const SeenPerson& x) {
    return x.id != id_ && !others_.contains(x.id) && is_steady(x) &&
           distance(x.place, place) < options_.reach;
  });
}

FollowedPerson::People::iterator FollowedPerson::find_lost(People people) const {
  const double away = static_cast<double>(time_ - last_time_) * 1e-6;
  const auto place = expected(*last_, last_time_);
  const auto off = [&](const SeenPerson& x) {
    return std::min(distance(x.place, place), distance(x.place, last_->place));
  };
  const auto comes_back = [&](const SeenPerson& x) {
    constexpr double opposite = 2; // radians
    return time_ - last_time_ < options_.turns_after && x.speed > options_.walking &&
           last_->speed > options_.walking &&
           std::abs(normalised(x.heading - last_->heading)) > opposite;
  };
  auto result = people.end();
  double nearest = std::min(options_.farthest, options_.reach + options_.growth * away);
  for (auto i = people.begin(); i != people.end(); ++i)
    if (!others_.contains(i->id) && !comes_back(*i) && off(*i) < nearest) {
      nearest = off(*i);
      result = i;
    }
  return result;
}

std::optional<SeenPerson> FollowedPerson::find(People people, std::int64_t time) {
  time_ = time;
  if (steady_ && time - steady_time_ > options_.doubt)
    steady_.reset();
  auto found = std::ranges::find(people, id_, &SeenPerson::id);
  if (const auto successor = find_successor(people); successor != people.end())
    found = successor;
  else if (found == people.end() && last_)
    found = find_lost(people);
  if (found == people.end())
    return std::nullopt;
  id_ = found->id;
  last_ = *found;
  last_time_ = time;
  if (is_steady(*found)) {
    steady_ = *found;
    steady_time_ = time;
  }
  // While it is in doubt who the person is, anybody may be.
  if (!steady_ || steady_time_ == time)
    for (const auto& x : people)
      if (x.id != id_)
        others_.insert(x.id);
  return *found;
}

} // namespace castor::mapping
