#pragma once

#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/building/building.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::benchmark {

/// A building with people whose routes and speeds depend on a seed.
struct Scene {
  mapping::Building building;
  /// Where the robot drives, again and again; it stands if empty.
  mapping::Path path;
};

/// Names of the scenes, in the order of tables:
/// crossing: two people whose ways cross at 30 to 180 degrees, and who pass at 0.2 to 0.5 m;
/// occlusion: the same, behind a column;
/// together: two pairs who walk side by side, 0.6 m apart;
/// hall: seven people;
/// standing: five people who stand for some seconds again and again;
/// furniture: four people among tables with legs, chairs and a shelf;
/// office: the default building, six people, the robot stands in the corridor;
/// driving: the same, the robot drives its path.
const std::vector<std::string>& scene_names();

/// \throws std::invalid_argument if there is no scene of that name.
Scene scene(const std::string& name, std::uint64_t seed);

/// The default building and somebody, the first of its people, who walks a loop along the corridor
/// and through lounge and laboratory; the robot begins behind. Alone; with "pauses" at the corners;
/// or with "others", four people around the corridor, or "heedless" ones, the same; or with "guide"
/// among four as well, waiting for the robot.
mapping::Building walk_to_follow(const std::string& name, std::uint64_t seed);

} // namespace castor::benchmark
