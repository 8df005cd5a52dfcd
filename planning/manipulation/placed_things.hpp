#pragma once

#include "castor/planning/manipulation/seen_table.hpp"

#include <map>
#include <string>
#include <vector>

namespace castor::manipulation {

/// Things that an arm has put down itself. They are as large as before, and where they were put,
/// also if a picture shows something else: in the arm's shadow, the dark side of a cube is not told
/// from the table, and a ball looks like a disc.
class PlacedThings {
public:
  /// @param id of what is seen there now
  /// @param before the thing as it was seen before it was taken
  /// @param pose of its middle where it was let go, in the arm's frame: so far above what it stands
  /// on that it does not seem to touch that
  /// @param fall how far above it was let go, metres
  void put(const std::string& id, const SeenThing& before, const Pose& pose, double fall = 0);

  /// How much lower a thing stands than its corrected pose says, metres; 0 for what was not put down,
  /// or is seen where it stands.
  double fall_of(const std::string& id) const;

  /// It is taken away.
  void forget(const std::string& id) { things_.erase(id); }

  /// Corrects the sizes and poses of what is seen where it was put, and not as large as it is. What
  /// is not seen there any more is forgotten.
  void correct(std::vector<SeenThing>& things);

private:
  struct Placed {
    SeenThing thing;
    double fall = 0;
    /// As large as it is: its pose is the one that is seen.
    bool is_seen = false;
  };

  /// By the ids of what is seen there.
  std::map<std::string, Placed> things_;
};

} // namespace castor::manipulation
