#include "castor/benchmarks/nlvr/nlvr_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace castor::nlvr {

namespace {

using communication::test::PicturedItem;
using communication::test::PictureScene;
using nlohmann::json;

/// Side of a box in the records, pixels, and how large a pixel is, metres.
constexpr double side_in_pixels = 100;
constexpr double pixel = box_side / side_in_pixels;

/// By so much blocks of a tower may be beside each other, or apart; metres.
constexpr double gap_in_tower = 0.002;

std::string colour_of(const std::string& colour) {
  if (colour == "Yellow")
    return "yellow";
  return colour == "Black" ? "black" : "blue";
}

/// Pictures have y downwards.
PicturedItem item_of(const json& x) {
  const double size = x.at("size");
  return {x.at("type"), colour_of(x.at("color")), x.at("x_loc").get<double>() * pixel,
          (side_in_pixels - x.at("y_loc").get<double>() - size) * pixel, size * pixel};
}

bool is_about(double a, double b) {
  return std::abs(a - b) <= gap_in_tower;
}

bool is_tower(Items box) {
  std::ranges::sort(box, {}, &PicturedItem::z);
  double top = 0;
  for (auto& x : box) {
    if (x.shape != "square" || !is_about(x.x, box.front().x) ||
        !is_about(x.size, box.front().size) || !is_about(x.z, top))
      return false;
    top = x.z + x.size;
  }
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
    for (auto& box : record.at("structured_rep")) {
      auto& items = x.boxes.emplace_back();
      for (auto& item : box)
        items.push_back(item_of(item));
    }
    result.push_back(std::move(x));
  }
  return result;
}

PictureScene scene_of(const std::vector<Items>& boxes) {
  // A box without anything in it is one of a picture of towers if the others are.
  const bool is_stacked = std::ranges::all_of(boxes, is_tower);
  PictureScene scene;
  for (auto& items : boxes)
    scene.add_box(items, box_side, is_stacked);
  return scene;
}

} // namespace castor::nlvr
