#include "castor/mapping/maps/map_file_error.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/output.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;

struct MapCheckArguments {
  std::string file;
  bool json = false;
};

/// What a map that can be read is of no use for.
std::vector<Diagnostic> doubts_about(const mapping::CellMap& map, const Json& cells,
                                     const std::string& file) {
  std::vector<Diagnostic> result;
  auto add = [&](std::string message, std::string remedy) {
    result.push_back({.severity = Severity::warning,
                      .where = {file, 0},
                      .line = {},
                      .expanded = {},
                      .message = std::move(message),
                      .remedy = std::move(remedy)});
  };
  if (cells["free"] == 0)
    add("no cell is free: no robot can be in it", "Check negate, mode and free_thresh.");
  if (cells["occupied"] == 0)
    add("no cell is occupied: a laser sees nothing in it",
        "Check negate, mode and occupied_thresh.");
  if (map.origin.heading != 0)
    add("the map is turned: robots are neither simulated nor localised in it",
        "Set the third number of its origin to 0.");
  return result;
}

Json summary_of_map(const mapping::CellMap& map, const std::string& file) {
  // Percent, as ROS's map_server has it.
  constexpr int occupied_from = 65;
  auto occupied =
    std::ranges::count_if(map.cells, [](std::int8_t x) { return x >= occupied_from; });
  auto unknown = std::ranges::count_if(map.cells, [](std::int8_t x) { return x < 0; });
  auto free = static_cast<std::int64_t>(map.cells.size()) - occupied - unknown;
  return {{"file", file},
          {"columns", map.columns},
          {"rows", map.rows},
          {"cell_size", map.cell_size},
          {"length", map.columns * map.cell_size},
          {"width", map.rows * map.cell_size},
          {"origin", {{"x", map.origin.x}, {"y", map.origin.y}, {"heading", map.origin.heading}}},
          {"cells", {{"occupied", occupied}, {"free", free}, {"unknown", unknown}}},
          {"free_area", static_cast<double>(free) * map.cell_size * map.cell_size}};
}

std::string map_as_text(const Json& map) {
  auto total = std::max(1., map["columns"].get<double>() * map["rows"].get<double>());
  auto percent = [&](const char* what) { return 100 * map["cells"][what].get<double>() / total; };
  return fmt::format("{}: {} x {} cells of {:g} m, {:.1f} m x {:.1f} m\n"
                     "lower left corner at {:g} {:g}, turned by {:g} radians\n"
                     "{:.1f} % occupied, {:.1f} % free ({:.1f} m2), {:.1f} % unknown\n",
                     map["file"].get<std::string>(), map["columns"].dump(), map["rows"].dump(),
                     map["cell_size"].get<double>(), map["length"].get<double>(),
                     map["width"].get<double>(), map["origin"]["x"].get<double>(),
                     map["origin"]["y"].get<double>(), map["origin"]["heading"].get<double>(),
                     percent("occupied"), percent("free"), map["free_area"].get<double>(),
                     percent("unknown"));
}

int check_map(const MapCheckArguments& arguments) {
  mapping::CellMap map;
  try {
    map = mapping::read_map_server(arguments.file);
  } catch (const mapping::MapFileError& e) {
    print(e.problems());
    return bad_input;
  }
  auto summary = summary_of_map(map, arguments.file);
  print(doubts_about(map, summary["cells"], arguments.file));
  print(arguments.json ? summary.dump() + '\n' : map_as_text(summary));
  return success;
}

} // namespace

void add_map_check(CLI::App& group, Action& chosen) {
  auto arguments = std::make_shared<MapCheckArguments>();
  auto* check = group.add_subcommand("check", "check a map of ROS's map_server, and describe it");
  check->add_option("FILE", arguments->file, "the map's .yaml")->type_name("")->required();
  add_json_flag(*check, arguments->json);
  check->footer("Prints the map's size, and how much of it is occupied, free and unknown. All "
                "problems of the .yaml are printed\nwith their lines and what to do, and so is an "
                "image that is missing or damaged; with an error, the exit\nstatus is 2.\n"
                "Examples: castor map check out/map.yaml\n"
                "          castor map check out/map.yaml --json");
  on_call(*check, chosen, arguments, check_map);
}

} // namespace castor::cli
