#pragma once

#include "castor/planning/manipulation/seen_table.hpp"

#include <map>
#include <string>
#include <vector>

namespace castor::manipulation {

/// How far from where it is a thing may be seen whose middle is that high, metres: vision takes it to
/// be on the table, and so sees it farther from the camera.
inline double seen_off(double height) {
  constexpr double share = 0.6;
  return share * height;
}

/// Things that an arm has put down itself. They are as large as before, and where they were put,
/// also if a picture shows something else: in the arm's shadow, the dark side of a cube is not told
/// from the table, and a ball looks like a disc.
class PlacedThings {
public:
  /// @param id of what is seen there now
  /// @param before the thing as it was seen before it was taken
  /// @param pose of its middle, in the arm's frame
  void put(const std::string& id, const SeenThing& before, const Pose& pose);

  /// Corrects the sizes and poses of what is seen where it was put, and not as large as it is. What
  /// is not seen there any more is forgotten.
  void correct(std::vector<SeenThing>& things);

private:
  /// By the ids of what is seen there.
  std::map<std::string, SeenThing> things_;
};

} // namespace castor::manipulation
