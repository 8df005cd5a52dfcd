#include "castor/planning/manipulation/joint_path.hpp"

#include "castor/planning/manipulation/kinematics.hpp"

namespace castor::manipulation {

double path_length(const std::vector<Configuration>& waypoints) {
  double result = 0;
  for (std::size_t i = 1; i < waypoints.size(); ++i)
    result += distance(waypoints[i - 1], waypoints[i]);
  return result;
}

} // namespace castor::manipulation
