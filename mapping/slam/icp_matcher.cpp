#include "castor/mapping/slam/icp_matcher.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPosePDF.h>
#include <mrpt/slam/CICP.h>

#include <algorithm>
#include <cmath>

namespace castor::mapping {

namespace {

void fill(mrpt::maps::CSimplePointsMap& map, const SurfacePoints& points) {
  map.reserve(points.size());
  for (const auto& x : points)
    if (x.has_normal())
      map.insertPointFast(static_cast<float>(x.position.x), static_cast<float>(x.position.y), 0);
  // insertPointFast() does not tell the search tree.
  map.mark_as_modified();
}

} // namespace

ScanMatch IcpMatcher::match(const PointMap& map, const SurfacePoints& scan, const Pose2& guess,
                            const std::optional<PosePrior>&) const {
  ScanMatch result;
  result.pose = guess;
  mrpt::maps::CSimplePointsMap there;
  mrpt::maps::CSimplePointsMap here;
  fill(there, map.points());
  fill(here, scan);
  if (there.empty() || here.empty())
    return result;
  mrpt::slam::CICP icp;
  icp.options.maxIterations = static_cast<unsigned>(options_.max_iterations);
  icp.options.thresholdDist = options_.first_distance;
  icp.options.thresholdAng = 0;
  icp.options.smallestThresholdDist = options_.last_distance;
  icp.options.ALFA = options_.shrinking;
  icp.options.covariance_varPoints = options_.noise * options_.noise;
  icp.options.corresponding_points_decimation = 1;
  mrpt::slam::CICP::TReturnInfo info;
  auto found =
    icp.Align(&there, &here, mrpt::poses::CPose2D(guess.x, guess.y, guess.heading), info);
  const auto mean = found->getMeanVal();
  Pose2 pose{mean.x(), mean.y(), normalised(mean.phi())};
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.heading))
    return result;
  double matched = 0;
  double squares = 0;
  double points = 0;
  double squared_arms = 0;
  for (const auto& x : transform(pose, scan)) {
    if (!x.has_normal())
      continue;
    ++points;
    if (const auto* nearest = map.nearest(x, options_.last_distance)) {
      ++matched;
      auto arm = distance(x.position, Point2{pose.x, pose.y});
      squared_arms += arm * arm;
      auto off = distance(x.position, nearest->position);
      squares += off * off;
    }
  }
  if (matched < 5)
    return result;
  result.pose = pose;
  result.matched = matched / points;
  result.deviation = std::sqrt(squares / matched);
  // Of matched points whose noise is independent, each at the end of its arm.
  auto variance = options_.noise * options_.noise;
  result.covariance.xx = result.covariance.yy = variance / matched;
  result.covariance.heading = variance / std::max(squared_arms, 1.);
  return result;
}

} // namespace castor::mapping
