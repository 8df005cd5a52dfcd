#include "castor/mapping/movement/followed_person.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

bool FollowedPerson::goes_on(const SeenPerson& x) const {
  const auto& before = steady_.front().person;
  return before.speed < options_.walking ||
         (x.speed > before.speed / 2 &&
          std::abs(normalised(x.heading - before.heading)) < options_.turn);
}

Point2 FollowedPerson::expected(const Sight& x) const {
  // Nobody walks on for ever.
  constexpr double longest = 3; // seconds
  const double way = x.person.speed * std::min(static_cast<double>(time_ - x.time) * 1e-6, longest);
  return {x.person.place.x + way * std::cos(x.person.heading),
          x.person.place.y + way * std::sin(x.person.heading)};
}

bool FollowedPerson::has_swapped(const SeenPerson& x) const {
  const auto before = lately_.find(x.id);
  return before != lately_.end() && x.speed > options_.walking &&
         before->second.front().person.speed > options_.walking &&
         std::abs(normalised(x.heading - before->second.front().person.heading)) > options_.turn;
}

FollowedPerson::People::iterator FollowedPerson::find_successor(People people) const {
  if (!is_in_doubt_ || time_ - doubt_since_ > options_.doubt)
    return people.end();
  const auto place = expected(steady_.front());
  return std::ranges::find_if(people, [&](const SeenPerson& x) {
    return x.id != id_ && (!others_.contains(x.id) || has_swapped(x)) && goes_on(x) &&
           distance(x.place, place) < options_.reach;
  });
}

bool FollowedPerson::is_taken(const SeenPerson& x) const {
  constexpr double beside = 1.2; // metres
  constexpr double same = 1;     // radians
  return std::ranges::any_of(lately_, [&](const auto& other) {
    const auto& sights = other.second;
    return other.first != x.id && others_.contains(other.first) &&
           sights.front().person.speed > options_.walking &&
           std::abs(normalised(sights.front().person.heading - x.heading)) < same &&
           distance(sights.back().person.place, x.place) < beside;
  });
}

void FollowedPerson::remember_all(People people) {
  for (const auto& x : people)
    lately_[x.id].push_back({time_, x});
  for (auto& [id, sights] : lately_)
    while (!sights.empty() && time_ - sights.front().time > options_.window)
      sights.pop_front();
  std::erase_if(lately_, [](const auto& x) { return x.second.empty(); });
}

bool FollowedPerson::comes_back(const SeenPerson& x) const {
  constexpr double opposite = 2; // radians
  const auto& last = last_->person;
  return time_ - last_->time < options_.turns_after && x.speed > options_.walking &&
         last.speed > options_.walking && std::abs(normalised(x.heading - last.heading)) > opposite;
}

bool FollowedPerson::may_have_walked_to(const SeenPerson& x) const {
  const double away = static_cast<double>(time_ - last_->time) * 1e-6;
  const auto& last = last_->person;
  const double speed = std::max(options_.walking, last.speed);
  const double way = distance(last.place, x.place);
  if (way > options_.reach + std::min(options_.farthest, options_.hurry * speed * away))
    return false;
  if (way < options_.reach || distance(x.place, expected(*last_)) < options_.reach)
    return true;
  // Who stands elsewhere stood there before.
  if (x.speed <= options_.walking)
    return false;
  // Away from there.
  constexpr double aside = 1.2; // radians
  const double direction = std::atan2(x.place.y - last.place.y, x.place.x - last.place.x);
  return std::abs(normalised(x.heading - direction)) < aside;
}

FollowedPerson::People::iterator FollowedPerson::find_lost(People people) {
  const auto place = expected(*last_);
  for (const auto& x : people)
    if (comes_back(x))
      others_.insert(x.id);
  auto result = people.end();
  for (auto i = people.begin(); i != people.end(); ++i)
    if (!others_.contains(i->id) && may_have_walked_to(*i) &&
        (result == people.end() || distance(i->place, place) < distance(result->place, place)))
      result = i;
  return result;
}

void FollowedPerson::remember(const SeenPerson& x) {
  if (!steady_.empty() && !is_in_doubt_ && time_ - steady_.back().time > options_.doubt)
    steady_.clear();
  if (is_in_doubt_ && time_ - doubt_since_ > options_.doubt)
    steady_.clear();
  const bool was_in_doubt = is_in_doubt_;
  is_in_doubt_ = !steady_.empty() && !goes_on(x);
  if (is_in_doubt_ && !was_in_doubt)
    doubt_since_ = time_;
  if (is_in_doubt_)
    return;
  steady_.push_back({time_, x});
  while (time_ - steady_.front().time > options_.window)
    steady_.pop_front();
}

std::optional<SeenPerson> FollowedPerson::find(People people, std::int64_t time) {
  time_ = time;
  auto found = std::ranges::find(people, id_, &SeenPerson::id);
  // The tracker took somebody else for the person, who was hidden.
  constexpr std::int64_t hidden = 300'000; // microseconds
  if (found != people.end() && last_ && time - last_->time > hidden && comes_back(*found)) {
    others_.insert(id_);
    found = people.end();
  } else if (others_.contains(id_)) {
    found = people.end();
  }
  if (const auto successor = find_successor(people); successor != people.end())
    found = successor;
  else if (found != people.end() && is_in_doubt_ && is_taken(*found)) {
    // As one who was lost there.
    others_.insert(id_);
    last_ = steady_.back();
    steady_.clear();
    is_in_doubt_ = false;
    found = people.end();
  } else if (found == people.end() && last_)
    found = find_lost(people);
  remember_all(people);
  if (found == people.end())
    return std::nullopt;
  id_ = found->id;
  others_.erase(id_);
  last_ = Sight{time, *found};
  remember(*found);
  // While it is in doubt who the person is, anybody may be.
  if (!is_in_doubt_)
    for (const auto& x : people)
      if (x.id != id_)
        others_.insert(x.id);
  return *found;
}

} // namespace castor::mapping
