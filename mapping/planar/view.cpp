#include "castor/mapping/planar/view.hpp"

#include "castor/mapping/planar/beam_towards.hpp"

#include <cmath>
#include <utility>

namespace castor::mapping {

View::View(std::shared_ptr<const LaserScan> scan, const Pose2& robot)
  : scan_(std::move(scan)), scanner_(compose(robot, scan_->mount)),
    cosine_(std::cos(scanner_.heading)), sine_(std::sin(scanner_.heading)) {}

bool View::passes(const Point2& point, double behind) const {
  const double x = point.x - scanner_.x;
  const double y = point.y - scanner_.y;
  const double way = std::hypot(x, y);
  const auto beam = beam_towards(*scan_, {cosine_ * x + sine_ * y, cosine_ * y - sine_ * x});
  if (!beam)
    return false;
  for (auto i = *beam - 1; i <= *beam + 1; ++i)
    if (!(scan_->ranges[i] > way + behind))
      return false;
  return true;
}

} // namespace castor::mapping
