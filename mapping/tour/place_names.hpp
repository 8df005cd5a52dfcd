#pragma once

#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::mapping {

/// Names of places that a robot is shown, until it knows which areas they are. Somebody who names a
/// room stands in it, and the robot may still be behind, in the door: the name is that of the
/// robot's area as soon as there is no gateway between the robot and where the other one stood. Of
/// a door that is found later, the name stays on its side.
class PlaceNames {
public:
  struct Named {
    std::int64_t area = -1;
    std::string name;

    friend bool operator==(const Named&, const Named&) = default;
  };

  /// @param where the speaker stood, or the robot
  void add(const std::string& name, const Point2& where);

  /// Whether nothing was named yet.
  bool is_empty() const { return waiting_.empty() && given_.empty(); }

  /// A name that turned out to be that of another area.
  struct Moved {
    std::int64_t from = -1;
    Named now;

    friend bool operator==(const Moved&, const Moved&) = default;
  };

  /// Those of the names that were known already whose places belong to other areas now.
  std::vector<Moved> take_moved(const std::vector<GraphNode>& nodes);

  /// The names whose areas are known now, once each.
  /// @param position area of the robot, by its newest keyframe
  std::vector<Named> take_known(const Pose2& robot, const RobotArea& position,
                                const std::vector<GraphNode>& nodes);

private:
  struct Waiting {
    std::string name;
    Point2 where;
  };

  struct Given {
    Named named;
    /// Place that said which area it is.
    std::int64_t node = -1;
    Point2 where;
  };

  std::vector<Waiting> waiting_;
  std::vector<Given> given_;
};

} // namespace castor::mapping
