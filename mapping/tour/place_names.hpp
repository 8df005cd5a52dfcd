#pragma once

#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::mapping {

/// Names of places that a robot is shown, until it knows which areas they are. Somebody who names a
/// room stands in it, and the robot may still be behind, in the door: the name is that of the
/// robot's area as soon as there is no gateway between the robot and where the other one stood.
class PlaceNames {
public:
  struct Named {
    std::int64_t area = -1;
    std::string name;

    friend bool operator==(const Named&, const Named&) = default;
  };

  /// @param where the speaker stood, or the robot
  void add(const std::string& name, const Point2& where);

  bool is_empty() const { return waiting_.empty(); }

  /// The names whose areas are known now, which it forgets.
  /// @param position area of the robot, by its newest keyframe
  std::vector<Named> take_known(const Pose2& robot, const RobotArea& position,
                                const std::vector<GraphNode>& nodes);

private:
  struct Waiting {
    std::string name;
    Point2 where;
  };

  std::vector<Waiting> waiting_;
};

} // namespace castor::mapping
