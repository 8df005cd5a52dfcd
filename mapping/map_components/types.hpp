#pragma once

#include "castor/wm/values/reflect.hpp"

#include <string>
#include <vector>

/// Requests to the component that writes map files.
namespace castor::mapping {

/// Call: write the map as it is now. Answer: ExportedMap.
struct ExportMap {
  /// The folder for the files, on the machine of the component; it is made if it does not exist.
  std::string folder;
};

struct ExportedMap {
  /// Paths of the files that were written.
  std::vector<std::string> files;
  /// What was left out, with the reason: "map.ot: there is no octree".
  std::vector<std::string> left_out;

  friend bool operator==(const ExportedMap&, const ExportedMap&) = default;
};

CASTOR_REFLECT(ExportMap, folder)
CASTOR_REFLECT(ExportedMap, files, left_out)

} // namespace castor::mapping
