#include "castor/mapping/map_components/keyframe_poses.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace castor::mapping {

Pose2 pose_in_map(const Keyframe& keyframe, const GraphPoses* graph) {
  if (graph == nullptr)
    return keyframe.local_pose;
  if (keyframe.number >= 0 && static_cast<std::size_t>(keyframe.number) < graph->poses.size())
    return graph->poses[static_cast<std::size_t>(keyframe.number)];
  return compose(graph->local_frame, keyframe.local_pose);
}

std::array<double, 6> information_of(const PoseCovariance& c) {
  // Cofactors of the symmetric matrix.
  auto xx = c.yy * c.heading - c.y_heading * c.y_heading;
  auto xy = c.x_heading * c.y_heading - c.xy * c.heading;
  auto xh = c.xy * c.y_heading - c.x_heading * c.yy;
  auto yy = c.xx * c.heading - c.x_heading * c.x_heading;
  auto yh = c.x_heading * c.xy - c.xx * c.y_heading;
  auto hh = c.xx * c.yy - c.xy * c.xy;
  auto determinant = c.xx * xx + c.xy * xy + c.x_heading * xh;
  // Sylvester's criterion.
  if (c.xx > 0 && hh > 0 && determinant > 0)
    return {xx / determinant, xy / determinant, xh / determinant,
            yy / determinant, yh / determinant, hh / determinant};
  constexpr double least = 1e-9;
  return {1 / std::max(c.xx, least), 0, 0,
          1 / std::max(c.yy, least), 0, 1 / std::max(c.heading, least)};
}

MapContents contents_of(std::vector<Keyframe> keyframes, const std::optional<GraphPoses>& graph,
                        const std::vector<Constraint>& constraints) {
  std::ranges::sort(keyframes, {}, &Keyframe::number);
  MapContents result;
  std::map<std::int64_t, std::size_t> positions;
  for (auto& x : keyframes) {
    positions[x.number] = result.keyframes.size();
    result.keyframes.push_back(
      {x.time, pose_in_map(x, graph ? &*graph : nullptr), x.odometry, std::move(x.scan)});
  }
  for (auto& x : constraints) {
    auto from = positions.find(x.from);
    auto to = positions.find(x.to);
    if (from != positions.end() && to != positions.end())
      result.constraints.push_back(
        {from->second, to->second, x.pose, information_of(x.covariance)});
  }
  return result;
}

} // namespace castor::mapping
