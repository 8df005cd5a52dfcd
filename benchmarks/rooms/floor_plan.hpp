#pragma once

#include "castor/mapping/grid/cell_map.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// Floor plans of the data set of R. Bormann et al. (ICRA 2016; repository ipa_coverage_planning):
/// images of 0.05 m a pixel, in which pixels brighter than 250 are free.
namespace castor::mapping {

/// A plan is there empty, furnished, and furnished with trash bins.
struct FloorPlanVariant {
  std::string name;
  /// What a file's name has after that of the plan.
  std::string suffix;
};

/// "empty", "furnished" and "trash bins".
const std::vector<FloorPlanVariant>& floor_plan_variants();

/// Names of the plans in a folder, in order: those with a file `<name>_gt_segmentation.png`.
/// @throws std::filesystem::filesystem_error if there is no such folder
std::vector<std::string> floor_plans(const std::filesystem::path& folder);

/// A file of the plan as a map: cells are 0 or 100 percent.
/// @throws MapFileError if it cannot be read
CellMap read_floor_plan(const std::filesystem::path& image);

/// The true rooms: free cells of the file `<name>_gt_segmentation.png` that are connected.
/// @throws MapFileError if it cannot be read
std::vector<std::int32_t> read_true_rooms(const std::filesystem::path& folder,
                                          const std::string& plan);

} // namespace castor::mapping
