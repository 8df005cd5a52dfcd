#include "castor/mapping/map_components/keyframe_backlog.hpp"

#include "castor/mapping/map_components/keyframe_poses.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cmath>
#include <utility>

namespace castor::mapping {

namespace {

bool is_same(const Pose2& a, const Pose2& b) {
  constexpr double metres = 1e-4;
  constexpr double radians = 1e-4;
  return distance(a, b) < metres && std::abs(normalised(a.heading - b.heading)) < radians;
}

} // namespace

void KeyframeBacklog::add(const EntryOf<Keyframe>& keyframe) {
  const auto number = keyframe->number;
  if (!known_.try_emplace(number, Known{keyframe, {}}).second)
    return;
  numbers_[keyframe.address.id] = number;
  pass_.insert(number);
}

bool KeyframeBacklog::remove(const std::string& id) {
  const auto number = numbers_.find(id);
  if (number == numbers_.end())
    return false;
  const auto known = known_.find(number->second);
  const bool was_told = known->second.told.has_value();
  pass_.erase(number->second);
  next_pass_.erase(number->second);
  known_.erase(known);
  numbers_.erase(number);
  return was_told;
}

void KeyframeBacklog::correct(std::shared_ptr<const GraphPoses> graph) {
  graph_ = std::move(graph);
  for (auto& [number, x] : known_)
    // Those that the follower does not know of will be told where they are by then.
    if (x.told && !pass_.contains(number) &&
        !is_same(*x.told, pose_in_map(*x.keyframe, graph_.get())))
      (is_under_way_ ? next_pass_ : pass_).insert(number);
}

std::optional<PlacedKeyframe> KeyframeBacklog::take() {
  if (pass_.empty())
    return std::nullopt;
  is_under_way_ = true;
  auto& x = known_.at(*pass_.begin());
  pass_.erase(pass_.begin());
  x.told = pose_in_map(*x.keyframe, graph_.get());
  return PlacedKeyframe{x.keyframe, *x.told};
}

bool KeyframeBacklog::begin_pass() {
  is_under_way_ = false;
  pass_.merge(std::exchange(next_pass_, {}));
  return has_next();
}

} // namespace castor::mapping
