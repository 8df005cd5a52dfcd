#include "castor/mapping/movement/mover_watch.hpp"

#include "castor/mapping/people/scan_view.hpp"

namespace castor::mapping {

namespace {

/// One who is not seen for so long has gone elsewhere, seconds.
constexpr double mover_patience = 1.5;

TrackOptions track_options() {
  TrackOptions result;
  result.patience = mover_patience;
  return result;
}

} // namespace

MoverWatch::MoverWatch() : detector_(DetectorOptions{}), tracks_(track_options()) {
  // nop
}

void MoverWatch::add(const LaserScan& scan) {
  const auto newest = odometry_.newest();
  if (!newest)
    return;
  const auto robot = odometry_.pose_at(scan.time).value_or(newest->pose);
  const auto parts = detector_.detect(scan, robot, tracks_.expected(scan.time));
  tracks_.add(parts, ScanView{scan, robot}, scan.time);
}

std::vector<Mover> MoverWatch::movers(const Pose2& robot) const {
  std::vector<Mover> result;
  const auto newest = odometry_.newest();
  if (!newest)
    return result;
  const auto frame = compose(robot, inverse(newest->pose));
  for (const auto& x : tracks_.people()) {
    const auto tip = transform(frame, Point2{x.place.x + x.velocity.x, x.place.y + x.velocity.y});
    const auto place = transform(frame, x.place);
    result.push_back({place, {tip.x - place.x, tip.y - place.y}});
  }
  return result;
}

} // namespace castor::mapping
