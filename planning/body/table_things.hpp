#pragma once

#include "castor/perception/vision/tabletop/tabletop_scene.hpp"
#include "castor/planning/body/arm_body.hpp"
#include "castor/planning/body/types.hpp"
#include "castor/planning/manipulation/table_world.hpp"

#include <map>
#include <string>
#include <vector>

namespace castor::manipulation {

/// The table of a scene as things that can be moved, and how they look.
class TableThings {
public:
  /// @param arm its pose in the table's frame
  TableThings(const vision::TabletopSnapshot& scene, const Pose& arm);

  /// The things as they rest; triangles count as discs. Names are those of the scene, or "the red
  /// cube", "the red cube 2".
  TableWorld world() const;

  /// What a camera sees of them and of the arm.
  std::vector<ViewedBody> view(const ArmBody& body) const;

  /// A pose of the arm's frame in the table's.
  Pose on_table(const Pose& in_arm) const;

private:
  vision::TableLook table_;
  Pose arm_;
  /// In the scene's order.
  std::vector<std::string> names_;
  std::map<std::string, vision::TabletopObject> looks_;
};

/// The scene with these in place of its objects.
vision::TabletopSnapshot snapshot_of(const vision::TabletopSnapshot& setting,
                                     const std::vector<ViewedBody>& bodies);

} // namespace castor::manipulation
