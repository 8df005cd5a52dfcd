#include "castor/mapping/slam/local_map.hpp"

#include <algorithm>
#include <utility>

namespace castor::mapping {

void LocalMap::place(std::shared_ptr<const LaserScan> scan, const Pose2& robot,
                     const SurfacePoints& on_robot) {
  PlacedScan added{std::move(scan), robot, on_robot, options_.moved};
  for (const auto& x : keyframes_)
    added.learn_from(x.view());
  for (const auto& x : looks_)
    added.learn_from(x);
  for (auto& x : keyframes_)
    x.learn_from(added.view());
  keyframes_.push_back(std::move(added));
  if (keyframes_.size() > options_.keyframes)
    keyframes_.pop_front();
  gather();
}

void LocalMap::look(const LaserScan& scan, const Pose2& robot) {
  std::erase_if(looks_, [&](const View& x) {
    return x.scan().time < scan.time - options_.look_memory || x.scan().time > scan.time;
  });
  if (!looks_.empty() && scan.time - looks_.back().scan().time < options_.look_period)
    return;
  looks_.emplace_back(std::make_shared<const LaserScan>(scan), robot);
  bool has_moved = false;
  for (auto& x : keyframes_)
    has_moved |= x.learn_from(looks_.back());
  if (has_moved)
    gather();
}

SurfacePoints LocalMap::standing(const SurfacePoints& on_robot, const Pose2& robot) const {
  const auto placed = transform(robot, on_robot);
  SurfacePoints result;
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (stood(placed[i].position))
      result.push_back(on_robot[i]);
  return result;
}

bool LocalMap::stood(const Point2& point) const {
  int times = 0;
  const auto is_moved = [&](const View& view) {
    times += view.passes(point, options_.moved.behind) ? 1 : 0;
    return times >= options_.moved.scans;
  };
  return std::ranges::none_of(looks_, is_moved) &&
         std::ranges::none_of(keyframes_, is_moved, &PlacedScan::view);
}

void LocalMap::gather() {
  SurfacePoints all;
  for (const auto& x : keyframes_) {
    const auto points = x.standing();
    all.insert(all.end(), points.begin(), points.end());
  }
  points_ = PointMap{all};
}

} // namespace castor::mapping
