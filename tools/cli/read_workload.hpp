#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/chaos/scene_text.hpp"
#include "castor/tools/chaos/workload.hpp"
#include "castor/tools/chaos/workload_places.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace castor::cli {

/// What a command is told in place of a file, in order to do without a workload.
inline constexpr const char* no_workload = "none";

/// A workload that fits a system.
struct CheckedWorkload {
  faults::Workload workload;
  faults::WorkloadPlaces places;
  /// What the cameras see, if there is one scene, and where it stands.
  std::optional<faults::SceneText> scene;
  std::filesystem::path scene_file;
};

/// The file that `given` says, or else the one beside the `.cast` file; empty if there is none.
/// Files that are installed with the command are found as `.cast` files are.
std::string workload_beside(const std::string& given, const std::string& system_file);

/// Reads a workload and prints whatever is wrong with it; nothing if it cannot be done.
std::optional<CheckedWorkload> read_workload(const std::string& file,
                                             const ArchitectureDescription& architecture);

} // namespace castor::cli
