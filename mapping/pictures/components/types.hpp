#pragma once

#include "castor/perception/vision/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <string>

namespace castor::mapping {

/// Entry: the map as it was drawn last, for timelines.
struct MapPicture {
  /// What was drawn: "grid, trajectory, 12 nodes of 3 areas".
  std::string content;
  vision::Image image;

  friend bool operator==(const MapPicture&, const MapPicture&) = default;
};

CASTOR_REFLECT(MapPicture, content, image)

} // namespace castor::mapping
