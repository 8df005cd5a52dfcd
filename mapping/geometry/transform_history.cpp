#include "castor/mapping/geometry/transform_history.hpp"

#include "castor/mapping/geometry/poses.hpp"

#include <algorithm>
#include <iterator>

namespace castor::geometry {

void TransformHistory::add(const Transform& x, Timestamp length, std::size_t max_count) {
  const Sample sample{Timestamp{x.time}, x.pose};
  if (x.is_fixed || is_fixed_)
    samples_.clear();
  is_fixed_ = x.is_fixed;
  const auto place = std::ranges::lower_bound(samples_, sample.time, {}, &Sample::time);
  if (place != samples_.end() && place->time == sample.time)
    *place = sample;
  else
    samples_.insert(place, sample);
  while (samples_.size() > 1 &&
         (samples_.size() > max_count || samples_.front().time < samples_.back().time - length))
    samples_.pop_front();
}

std::optional<Pose> TransformHistory::at(Timestamp time) const {
  if (is_fixed_)
    return samples_.front().pose;
  const auto after = std::ranges::lower_bound(samples_, time, {}, &Sample::time);
  if (after == samples_.end())
    return std::nullopt;
  if (after->time == time)
    return after->pose;
  if (after == samples_.begin())
    return std::nullopt;
  const auto before = std::prev(after);
  const double share = static_cast<double>((time - before->time).count()) /
                       static_cast<double>((after->time - before->time).count());
  return interpolate(before->pose, after->pose, share);
}

std::pair<Timestamp, Timestamp> TransformHistory::known() const {
  return {samples_.front().time, samples_.back().time};
}

} // namespace castor::geometry
