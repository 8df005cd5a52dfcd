#include "castor/mapping/movement/followed_person.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

std::optional<SeenPerson> FollowedPerson::find(std::span<const SeenPerson> people,
                                               std::int64_t time) {
  auto found = std::ranges::find(people, id_, &SeenPerson::id);
  if (found == people.end() && last_) {
    const double away = static_cast<double>(time - last_time_) * 1e-6;
    // Nobody walks on for ever.
    const double way = last_->speed * std::min(away, 2.0);
    const Point2 expected{last_->place.x + way * std::cos(last_->heading),
                          last_->place.y + way * std::sin(last_->heading)};
    const auto off = [&](const SeenPerson& x) {
      return std::min(distance(x.place, expected), distance(x.place, last_->place));
    };
    double nearest = std::min(options_.farthest, options_.reach + options_.growth * away);
    for (auto i = people.begin(); i != people.end(); ++i)
      if (!others_.contains(i->id) && off(*i) < nearest) {
        nearest = off(*i);
        found = i;
      }
  }
  if (found == people.end())
    return std::nullopt;
  id_ = found->id;
  last_ = *found;
  last_time_ = time;
  for (const auto& x : people)
    if (x.id != id_)
      others_.insert(x.id);
  return *found;
}

} // namespace castor::mapping
