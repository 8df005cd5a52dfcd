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

/// What of a system workloads act on.
struct WorkloadPlaces {
  std::vector<std::string> subarchitectures;
  /// Those that operators may not write to.
  std::vector<std::string> closed;
  /// The subarchitecture in which somebody parses what is said; empty for none.
  std::string listening;
  /// Components that look at a scene, and its file as the `.cast` file names it.
  struct Camera {
    std::string component;
    std::string file;
    /// Folder in which a relative file is looked for too.
    std::string base;
  };
  std::vector<Camera> cameras;
};

WorkloadPlaces places_of(const ArchitectureDescription& architecture);

/// What a workload names that the system does not have, and what it expects that cannot be.
/// @param scene what the cameras see, if there is one scene
/// @param problem_of why no such entry can be written; empty if it can
/// @param is_type whether there may be entries of a type
std::vector<Diagnostic>
check_workload(const Workload& workload, const WorkloadPlaces& places,
               const std::optional<SceneText>& scene,
               const std::function<std::string(const WriteEntry&)>& problem_of,
               const std::function<bool(const std::string& type)>& is_type);

} // namespace castor::faults
