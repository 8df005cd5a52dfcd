#pragma once

#include "castor/mapping/exploration/free_floor.hpp"

#include <string>
#include <vector>

namespace castor::mapping {

struct FrontierOptions {
  /// Shorter ones are noise: cells between two beams, metres.
  double least_size = 0.2;
  /// From how far a frontier is looked at, at most, metres.
  double view_distance = 1.5;
  /// From how far it is looked at best: the footprint stays in what is known to be free, metres.
  double best_view_distance = 0.5;
  /// How far the robot is expected to see into the unknown, metres.
  double sight = 4;
};

/// Free cells beside unknown ones, which are neighbours of one another.
struct Frontier {
  /// The free cell of it that is nearest to the middle of all.
  Point2 middle;
  /// Number of cells times their side, metres.
  double size = 0;
  /// Whether the robot gets to where it sees the frontier.
  bool is_reachable = false;
  /// Why it does not.
  std::string reason;
  /// Where the robot is to stand, facing the frontier; if it is reachable.
  Pose2 view;
  /// Length of the way there, metres.
  double cost = 0;
  /// Unknown floor that the robot may come to cover and is expected to see from there, square
  /// metres.
  double gain = 0;
};

/// The frontiers of a map (B. Yamauchi, "A frontier-based approach for autonomous exploration",
/// 1997), in no order. A door that is shut is a wall to a laser: it makes no frontier. One behind
/// which the robot fits nowhere is not reachable, so that nobody looks into each gap behind a
/// cupboard.
std::vector<Frontier> find_frontiers(const CellMap& map, const FreeFloor& floor,
                                     const FrontierOptions& options = {});

} // namespace castor::mapping
