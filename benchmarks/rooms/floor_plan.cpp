#include "castor/benchmarks/rooms/floor_plan.hpp"

#include "castor/benchmarks/rooms/room_scores.hpp"
#include "castor/mapping/maps/map_image.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace castor::mapping {

namespace {

constexpr std::string_view truth_ending = "_gt_segmentation.png";
/// As in the published evaluation.
constexpr double free_above = 250;
constexpr double pixel_size = 0.05; // metres

} // namespace

const std::vector<FloorPlanVariant>& floor_plan_variants() {
  static const std::vector<FloorPlanVariant> variants{
    {"empty", ""}, {"furnished", "_furnitures"}, {"trash bins", "_furnitures_trashbins"}};
  return variants;
}

std::vector<std::string> floor_plans(const std::filesystem::path& folder) {
  std::vector<std::string> result;
  for (const auto& x : std::filesystem::directory_iterator(folder)) {
    auto name = x.path().filename().string();
    if (name.ends_with(truth_ending))
      result.push_back(name.substr(0, name.size() - truth_ending.size()));
  }
  std::ranges::sort(result);
  return result;
}

CellMap read_floor_plan(const std::filesystem::path& image) {
  const auto pixels = read_map_image(image);
  CellMap result{.columns = pixels.width,
                 .rows = pixels.height,
                 .cell_size = pixel_size,
                 .origin = {},
                 .cells = std::vector<std::int8_t>(pixels.grey.size())};
  for (int row = 0; row < result.rows; ++row)
    for (int column = 0; column < result.columns; ++column) {
      auto pixel =
        static_cast<std::size_t>(result.rows - 1 - row) * static_cast<std::size_t>(result.columns) +
        static_cast<std::size_t>(column);
      result.at(column, row) = pixels.grey[pixel] > free_above ? 0 : 100;
    }
  return result;
}

std::vector<std::int32_t> read_true_rooms(const std::filesystem::path& folder,
                                          const std::string& plan) {
  const auto map = read_floor_plan(folder / (plan + std::string(truth_ending)));
  std::vector<bool> free;
  for (auto x : map.cells)
    free.push_back(x == 0);
  return connected_rooms(free, map.columns, map.rows);
}

} // namespace castor::mapping
