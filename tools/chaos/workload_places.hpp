#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/tools/chaos/scene_text.hpp"
#include "castor/tools/chaos/workload.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace castor::faults {

/// The parts of a system that workloads act on.
struct WorkloadPlaces {
  std::vector<std::string> subarchitectures;
  /// Subarchitectures that operators may not write to.
  std::vector<std::string> closed;
  /// The subarchitecture with an UtteranceParser; empty for none.
  std::string listening;
  /// A component that shows a scene, and the scene's file as named in the `.cast` file.
  struct Camera {
    std::string component;
    std::string file;
    /// Further folder to search for a relative file.
    std::string base;
  };
  std::vector<Camera> cameras;
};

WorkloadPlaces places_of(const ArchitectureDescription& architecture);

/// Errors in a workload: names unknown in the system, and expectations that cannot be met.
/// @param scene the scene that all cameras show, if there is exactly one
/// @param problem_of the reason why such an entry cannot be written; empty if it can
/// @param is_type whether an entry type exists
std::vector<Diagnostic>
check_workload(const Workload& workload, const WorkloadPlaces& places,
               const std::optional<SceneText>& scene,
               const std::function<std::string(const WriteEntry&)>& problem_of,
               const std::function<bool(const std::string& type)>& is_type);

} // namespace castor::faults
