#include "castor/benchmarks/clevr/clevr_scenes.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace castor::clevr {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Object parse_object(const Json& json) {
  Object object;
  json.at("shape").get_to(object.shape);
  json.at("color").get_to(object.colour);
  object.material = json.value("material", "");
  json.at("size").get_to(object.size);
  // As in colour names and in British survey answers.
  if (object.colour == "gray")
    object.colour = "grey";
  const auto& position = json.at("3d_coords");
  object.position = {position.at(0).get<double>(), position.at(1).get<double>(),
                     position.at(2).get<double>()};
  const auto& pixel = json.at("pixel_coords");
  object.pixel = {pixel.at(0).get<double>(), pixel.at(1).get<double>()};
  object.distance = pixel.at(2).get<double>();
  object.rotation = json.value("rotation", 0.0);
  return object;
}

ObjectPairs parse_pairs(const Json& related) {
  ObjectPairs pairs;
  for (std::size_t landmark = 0; landmark < related.size(); ++landmark) {
    for (const auto& target : related[landmark])
      pairs.emplace(landmark, target.get<std::size_t>());
  }
  return pairs;
}

/// Images by file name; there may be several of one name in different folders.
using ImageIndex = std::multimap<std::string, fs::path>;

std::size_t common_parts(const fs::path& a, const fs::path& b) {
  const auto ends = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return static_cast<std::size_t>(std::distance(a.begin(), ends.first));
}

/// The image of that name that is nearest to the scene file.
std::optional<fs::path> find_image(const ImageIndex& images, const std::string& name,
                                   const fs::path& scene_file) {
  const auto [first, last] = images.equal_range(fs::path(name).filename().string());
  if (first == last)
    return std::nullopt;
  return std::max_element(first, last,
                          [&](const auto& a, const auto& b) {
                            return common_parts(a.second, scene_file) <
                                   common_parts(b.second, scene_file);
                          })
    ->second;
}

void add_scene(const Json& json, const fs::path& file, const ImageIndex& images,
               std::map<fs::path, Scene>& scenes) {
  const auto objects = json.find("objects");
  if (objects == json.end() || !objects->is_array())
    return;
  const auto image =
    find_image(images, json.value("image_filename", file.stem().string() + ".png"), file);
  if (!image || scenes.contains(*image))
    return;
  Scene scene{*image, {}, {}};
  for (const auto& object : *objects)
    scene.objects.push_back(parse_object(object));
  if (const auto relations = json.find("relationships"); relations != json.end()) {
    for (const auto& [word, related] : relations->items())
      scene.relations.emplace(word, parse_pairs(related));
  }
  scenes.emplace(*image, std::move(scene));
}

} // namespace

std::vector<Scene> load_scenes(const fs::path& folder) {
  ImageIndex images;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".png" || extension == ".jpg")
      images.emplace(entry.path().filename().string(), entry.path());
    else if (extension == ".json")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::map<fs::path, Scene> scenes;
  for (const auto& file : files) {
    try {
      std::ifstream stream(file);
      const Json json = Json::parse(stream);
      if (!json.is_object())
        continue;
      const auto list = json.find("scenes");
      if (list == json.end()) {
        add_scene(json, file, images, scenes);
      } else {
        for (const auto& scene : *list)
          add_scene(scene, file, images, scenes);
      }
    } catch (const Json::exception& error) {
      throw std::runtime_error(file.string() + ": " + error.what());
    }
  }
  std::vector<Scene> result;
  for (auto& [path, scene] : scenes)
    result.push_back(std::move(scene));
  return result;
}

} // namespace castor::clevr
