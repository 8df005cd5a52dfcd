#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/chaos/scene_text.hpp"
#include "castor/tools/chaos/workload.hpp"
#include "castor/tools/chaos/workload_places.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace castor::cli {

/// Value of --workload in place of a file, for no workload.
inline constexpr const char* no_workload = "none";

/// A workload that was checked against a system.
struct CheckedWorkload {
  faults::Workload workload;
  faults::WorkloadPlaces places;
  /// The scene that all cameras show, if there is exactly one, and its file.
  std::optional<faults::SceneText> scene;
  std::filesystem::path scene_file;
};

/// The file `given`, or otherwise the one beside the `.cast` file; empty if there is none. Files
/// installed with the command are found in the same way as `.cast` files.
std::string workload_beside(const std::string& given, const std::string& system_file);

/// Reads a workload and prints all findings about it; nothing if there are errors.
std::optional<CheckedWorkload> read_workload(const std::string& file,
                                             const ArchitectureDescription& architecture);

} // namespace castor::cli
