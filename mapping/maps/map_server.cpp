#include "castor/mapping/maps/map_server.hpp"

#include "castor/base/input_file.hpp"
#include "castor/mapping/maps/flat_yaml.hpp"
#include "castor/mapping/maps/map_file_error.hpp"
#include "castor/mapping/maps/map_image.hpp"
#include "castor/mapping/maps/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

constexpr std::size_t max_yaml_bytes = 1 << 20;

std::optional<double> finite_number(const std::string& word) {
  double result = 0;
  auto begin = word.data() + (word.starts_with('+') ? 1 : 0);
  auto end = word.data() + word.size();
  auto [at, error] = std::from_chars(begin, end, result);
  if (error != std::errc{} || at != end || !std::isfinite(result))
    return std::nullopt;
  return result;
}

/// Takes the values of keys, and collects what is wrong with them.
class MapKeys {
public:
  MapKeys(std::vector<YamlItem> items, const std::string& file_name)
    : items_(std::move(items)), file_name_(file_name) {}

  const YamlItem* find(std::string_view key) const {
    auto x = std::ranges::find(items_, key, &YamlItem::key);
    return x == items_.end() ? nullptr : &*x;
  }

  std::string text(const std::string& key, const std::string& example) {
    auto* x = required(key, example);
    if (!x)
      return {};
    if (x->is_list || x->values.empty() || x->values[0].empty()) {
      add(x, fmt::format("'{}' has no value", key), fmt::format("Write for instance {}.", example));
      return {};
    }
    return x->values[0];
  }

  double number(const std::string& key, const std::string& example) {
    auto word = text(key, example);
    auto result = finite_number(word);
    if (!word.empty() && !result)
      add(find(key), fmt::format("'{}' is not a finite number", word),
          fmt::format("Write for instance {}.", example));
    return result.value_or(0);
  }

  bool flag(const std::string& key, const std::string& example) {
    auto word = text(key, example);
    if (word == "1" || word == "true" || word == "True")
      return true;
    if (!word.empty() && word != "0" && word != "false" && word != "False")
      add(find(key), fmt::format("'{}' is neither 0 nor 1", word), "Write 0 or 1.");
    return false;
  }

  Pose2 pose(const std::string& key) {
    const std::string example = "origin: [-10.0, -10.0, 0.0]";
    auto* x = required(key, example);
    if (!x)
      return {};
    std::vector<double> numbers;
    for (auto& word : x->values)
      if (auto number = finite_number(word))
        numbers.push_back(*number);
    if (numbers.size() != 3 || x->values.size() != 3) {
      add(x, fmt::format("'{}' is not a list of three finite numbers", key),
          fmt::format("Write x, y (metres) and yaw (radians), for instance {}.", example));
      return {};
    }
    return {numbers[0], numbers[1], normalised(numbers[2])};
  }

  /// The item of a key, whose lack is a problem.
  const YamlItem* required(const std::string& key, const std::string& example) {
    auto* result = find(key);
    if (!result)
      add(nullptr, fmt::format("the key '{}' is missing", key),
          fmt::format("Add a line such as {}.", example));
    return result;
  }

  void add(const YamlItem* item, std::string message, std::string remedy) {
    problems_.push_back({.where = {file_name_, item ? item->line : 0},
                         .line = item ? item->text : std::string{},
                         .expanded = {},
                         .message = std::move(message),
                         .remedy = std::move(remedy)});
  }

  void throw_problems() {
    if (problems_.empty())
      return;
    sort_by_line(problems_);
    throw MapFileError(std::move(problems_));
  }

private:
  std::vector<YamlItem> items_;
  std::string file_name_;
  std::vector<Diagnostic> problems_;
};

MapMode mode_of(MapKeys& keys) {
  auto* x = keys.find("mode");
  if (!x)
    return MapMode::trinary;
  auto word = x->values.empty() ? std::string{} : x->values[0];
  if (word == "scale")
    return MapMode::scale;
  if (word == "raw")
    return MapMode::raw;
  if (word != "trinary")
    keys.add(x, fmt::format("'{}' is not a mode", word), "Write trinary, scale or raw.");
  return MapMode::trinary;
}

/// Percent, or -1, as ROS's map_server interprets a pixel.
std::int8_t cell_of_pixel(double grey, bool transparent, const MapServerFile& file) {
  constexpr std::int8_t unknown = -1;
  if (file.mode == MapMode::raw)
    return grey <= 100 ? static_cast<std::int8_t>(std::lround(grey)) : unknown;
  auto p = file.negate ? grey / 255 : (255 - grey) / 255;
  if (file.mode == MapMode::scale && transparent)
    return unknown;
  if (p > file.occupied_threshold)
    return 100;
  if (p < file.free_threshold)
    return 0;
  if (file.mode == MapMode::trinary)
    return unknown;
  return static_cast<std::int8_t>(
    std::lround((p - file.free_threshold) / (file.occupied_threshold - file.free_threshold) * 100));
}

} // namespace

MapServerFile parse_map_server(std::string_view text, const std::string& file_name) {
  MapKeys keys{parse_flat_yaml(text, file_name), file_name};
  MapServerFile result;
  result.image = keys.text("image", "image: map.pgm");
  result.resolution = keys.number("resolution", "resolution: 0.05");
  if (auto* x = keys.find("resolution"); x && result.resolution <= 0)
    keys.add(x, "the resolution is not a number above 0",
             "Write the metres that a pixel has, for instance resolution: 0.05.");
  result.origin = keys.pose("origin");
  result.negate = keys.flag("negate", "negate: 0");
  result.occupied_threshold = keys.number("occupied_thresh", "occupied_thresh: 0.65");
  result.free_threshold = keys.number("free_thresh", "free_thresh: 0.196");
  for (auto* key : {"occupied_thresh", "free_thresh"}) {
    auto value = key[0] == 'o' ? result.occupied_threshold : result.free_threshold;
    if (value < 0 || value > 1)
      keys.add(keys.find(key), fmt::format("{} is not a probability", value),
               "Write a number from 0 to 1.");
  }
  if (auto* x = keys.find("occupied_thresh");
      x && keys.find("free_thresh") && result.occupied_threshold <= result.free_threshold)
    keys.add(x,
             fmt::format("occupied_thresh ({}) is not above free_thresh ({})",
                         result.occupied_threshold, result.free_threshold),
             "Make it larger: pixels that are darker than occupied_thresh are occupied, those that "
             "are lighter than free_thresh are free.");
  result.mode = mode_of(keys);
  keys.throw_problems();
  return result;
}

CellMap read_map_server(const std::filesystem::path& yaml) {
  std::string text;
  try {
    text = read_input_file(yaml, max_yaml_bytes);
  } catch (const InputFileError& e) {
    throw MapFileError(yaml.string(), 0, {}, e.what(), "Name the .yaml file of a map.");
  }
  auto file = parse_map_server(text, yaml.string());
  MapImage image;
  try {
    // An absolute path replaces the folder.
    image = read_map_image(yaml.parent_path() / file.image);
  } catch (const MapFileError& e) {
    auto items = parse_flat_yaml(text, yaml.string());
    auto item = *std::ranges::find(items, "image", &YamlItem::key);
    throw MapFileError(yaml.string(), item.line, item.text,
                       fmt::format("the image {}: {}", (yaml.parent_path() / file.image).string(),
                                   e.problems().front().message),
                       e.problems().front().remedy);
  }
  CellMap result;
  result.columns = image.width;
  result.rows = image.height;
  result.cell_size = file.resolution;
  result.origin = file.origin;
  result.cells.resize(image.grey.size());
  for (int row = 0; row < result.rows; ++row)
    for (int column = 0; column < result.columns; ++column) {
      // Images begin with the upper row.
      auto i =
        static_cast<std::size_t>(result.rows - 1 - row) * static_cast<std::size_t>(result.columns) +
        static_cast<std::size_t>(column);
      result.at(column, row) =
        cell_of_pixel(image.grey[i], !image.transparent.empty() && image.transparent[i], file);
    }
  return result;
}

void write_map_server(const CellMap& map, const std::filesystem::path& stem,
                      const MapClasses& classes) {
  auto pgm = stem;
  pgm += ".pgm";
  auto yaml = stem;
  yaml += ".yaml";
  if (map.columns <= 0 || map.rows <= 0)
    throw MapFileError(yaml.string(), 0, {}, "the map has no cells",
                       "Export it when the robot has seen something.");
  auto bytes = fmt::format("P5\n{} {}\n255\n", map.columns, map.rows);
  bytes.reserve(bytes.size() + map.cells.size());
  for (int row = map.rows - 1; row >= 0; --row)
    for (int column = 0; column < map.columns; ++column) {
      auto cell = map.at(column, row);
      auto grey = cell < 0                        ? 205
                  : cell >= classes.occupied_from ? 0
                  : cell <= classes.free_to       ? 254
                                                  : 205;
      bytes.push_back(static_cast<char>(grey));
    }
  // The image first: a `.yaml` without its image is of no use.
  write_output_file(pgm, bytes);
  write_output_file(yaml, fmt::format("image: {}\nmode: trinary\nresolution: {:.10g}\norigin: "
                                      "[{:.10g}, {:.10g}, {:.10g}]\nnegate: 0\n"
                                      "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                                      pgm.filename().string(), map.cell_size, map.origin.x,
                                      map.origin.y, map.origin.heading));
}

} // namespace castor::mapping
