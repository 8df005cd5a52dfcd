#pragma once

#include "castor/perception/vision/types.hpp"
#include "castor/planning/manipulation/scene.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// What vision says is on the table, as things for an arm.
namespace castor::manipulation {

/// A thing that vision sees.
struct SeenThing {
  /// Of its SceneObject.
  std::string id;
  /// As vision names them; "unknown" if it does not.
  std::string colour;
  std::string shape;
  /// In the arm's frame. Its name is a description, "the blue sphere", which no other has.
  NamedSolid thing;
};

/// The entries of vision.
struct SeenEntries {
  /// By their ids.
  std::map<std::string, vision::SceneObject> objects;
  std::map<std::string, vision::ROI> regions;
  std::optional<geometry::Camera> camera;
};

/// Things by the outlines of their regions, or by their boxes where there is no calibrated camera;
/// those whose place is not known are left out.
/// @param arm its pose in the table's frame
std::vector<SeenThing> seen_things(const SeenEntries& entries, const Pose& arm);

/// How far from where it is a thing may be seen whose middle is that high, metres: vision takes it
/// to be on the table, and so sees it farther from the camera.
inline double seen_off(double height) {
  constexpr double share = 0.6;
  return share * height;
}

/// Leaves out what is seen of the thing in the gripper, such as at the edge of the picture: nothing
/// else can be where it is.
/// @param at pose of its middle, in the arm's frame
void leave_out_held(std::vector<SeenThing>& things, const SeenThing& held, const Pose& at);

/// The table's surface and the things on it.
Scene scene_of(const std::vector<SeenThing>& things);

/// The thing that looks like `x` (the same colour if that is known, and the same shape if several
/// have that) and is nearest to a place of the arm's frame, at most `within` metres from it; null
/// if there is none.
const SeenThing* find_like(const std::vector<SeenThing>& things, const SeenThing& x,
                           const Point3& place, double within);

/// Places of the table before an arm, in its frame, where a thing has room between those that are
/// seen; the one with the most room first.
/// @param width of the thing, metres
/// @param wide also near to the arm and far to the side, where eyes are less exact
std::vector<Point3> free_places(const std::vector<SeenThing>& things, double width,
                                bool wide = false);

/// Horizontal distance, metres.
double distance_on_table(const Point3& a, const Point3& b);

} // namespace castor::manipulation
