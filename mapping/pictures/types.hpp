#pragma once

#include "castor/wm/values/reflect.hpp"

#include <string>

/// Requests to the component that draws what is known of a building.
namespace castor::mapping {

/// Call: draw the map as it is now. Answer: DrawnMap.
struct DrawMap {
  /// The PNG file, on the machine of the component.
  std::string file;
};

struct DrawnMap {
  std::string file;
  /// What was drawn: "grid, trajectory, 12 nodes of 3 areas".
  std::string content;

  friend bool operator==(const DrawnMap&, const DrawnMap&) = default;
};

CASTOR_REFLECT(DrawMap, file)
CASTOR_REFLECT(DrawnMap, file, content)

} // namespace castor::mapping
