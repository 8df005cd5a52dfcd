#include "castor/benchmarks/nlvr/nlvr_scenes.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace castor::nlvr {

namespace {

using communication::test::PicturedItem;
using nlohmann::json;

/// Side of a box, pixels, and how large a pixel is, metres.
constexpr double box_side = 100;
constexpr double pixel = 0.001;

/// Size of the blocks that towers are made of, and the gap between two of them; pixels.
constexpr double block_size = 20;
constexpr double block_distance = 21;

std::string colour_of(const std::string& colour) {
  if (colour == "Yellow")
    return "yellow";
  return colour == "Black" ? "black" : "blue";
}

/// Pictures have y downwards.
PicturedItem item_of(const json& x) {
  const double size = x.at("size");
  return {x.at("type"), colour_of(x.at("color")), x.at("x_loc").get<double>() * pixel,
          (box_side - x.at("y_loc").get<double>() - size) * pixel, size * pixel};
}

/// Blocks of one size above each other, from the floor on.
bool is_tower(const json& box) {
  std::vector<double> heights;
  for (auto& x : box) {
    if (x.at("type") != "square" || x.at("size") != block_size ||
        x.at("x_loc") != box.front().at("x_loc"))
      return false;
    heights.push_back(box_side - block_size - x.at("y_loc").get<double>());
  }
  std::ranges::sort(heights);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (heights[i] != static_cast<double>(i) * block_distance)
      return false;
  return true;
}

} // namespace

std::vector<Statement> read_statements(const std::filesystem::path& file) {
  std::ifstream in{file};
  if (!in)
    throw std::runtime_error{"cannot read " + file.string()};
  std::vector<Statement> result;
  for (std::string line; std::getline(in, line);) {
    const auto record = json::parse(line);
    Statement x;
    x.sentence = record.at("sentence");
    x.is_true = record.at("label") == "true";
    x.identifier = record.at("identifier");
    x.directory = record.at("directory");
    auto& boxes = record.at("structured_rep");
    // A box without anything in it is one of a picture of towers if the others are.
    const bool is_stacked = std::ranges::all_of(boxes, is_tower);
    for (auto& box : boxes) {
      std::vector<PicturedItem> items;
      for (auto& item : box)
        items.push_back(item_of(item));
      x.scene.add_box(items, box_side * pixel, is_stacked);
    }
    result.push_back(std::move(x));
  }
  return result;
}

} // namespace castor::nlvr
