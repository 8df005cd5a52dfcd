#include "castor/mapping/movement/footprint_room.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace castor::mapping {

FootprintRoom::FootprintRoom(const ClearanceMap& clearance, const Footprint& footprint,
                             double margin)
  : clearance_(clearance), outer_radius_(footprint.outer_radius()),
    kept_(std::hypot(margin, clearance.cell_size() / 2)) {
  const auto& outline = footprint.outline();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Segment side{outline[i], outline[(i + 1) % outline.size()]};
    const int pieces = static_cast<int>(std::ceil(length(side) / clearance.cell_size()));
    for (int k = 0; k < pieces; ++k)
      samples_.push_back(point_at(side, static_cast<double>(k) / pieces));
  }
  // Each point inside is within `kept_` of one of these, or of the outline.
  const double spacing = kept_ * std::sqrt(2.0);
  const int reach = static_cast<int>(std::ceil(outer_radius_ / spacing));
  for (int row = -reach; row <= reach; ++row)
    for (int column = -reach; column <= reach; ++column)
      if (const Point2 x{column * spacing, row * spacing}; contains(outline, x))
        samples_.push_back(x);
}

double FootprintRoom::at(const Pose2& robot) const {
  const double around = clearance_.between_cells({robot.x, robot.y}) - outer_radius_ - kept_;
  if (around > 0)
    return around;
  const double cosine = std::cos(robot.heading);
  const double sine = std::sin(robot.heading);
  double least = clearance_.between_cells({robot.x, robot.y});
  for (const auto& x : samples_) {
    least = std::min(least, clearance_.between_cells({robot.x + cosine * x.x - sine * x.y,
                                                      robot.y + sine * x.x + cosine * x.y}));
    if (least <= kept_)
      break;
  }
  return least - kept_;
}

bool FootprintRoom::is_free(const Pose2& begin, const Twist2& motion, double step) const {
  const double way = std::abs(motion.forward) + outer_radius_ * std::abs(motion.turn);
  double at_way = 0;
  while (at_way < way) {
    const double room = at(pose_on(begin, motion, at_way / way));
    if (room <= 0)
      return false;
    at_way += std::max(room, step);
  }
  return at(pose_on(begin, motion, 1)) > 0;
}

bool FootprintRoom::is_free(const PosePath& path, double step) const {
  auto begin = path.start;
  for (const auto& x : path.motions) {
    if (!is_free(begin, x, step))
      return false;
    begin = pose_on(begin, x, 1);
  }
  return true;
}

} // namespace castor::mapping
