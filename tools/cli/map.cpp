#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

namespace castor::cli {

namespace {

struct MapArguments {
  std::string system;
  std::string folder;
  std::string subarchitecture = "mapping";
  std::string timeout = "60s";
  bool json = false;
};

/// One line for each file, and for what was left out.
std::string files_as_text(const Json& answer) {
  std::string result;
  for (auto& x : answer["files"])
    result += fmt::format("wrote {}\n", x.get<std::string>());
  for (auto& x : answer["left_out"])
    result += fmt::format("left out {}\n", x.get<std::string>());
  return result;
}

int export_map(const MapArguments& arguments) {
  auto answer =
    ask_for_one(choose_system(arguments.system),
                {{"do", "call"},
                 {"subarchitecture", arguments.subarchitecture},
                 {"type", "ExportMap"},
                 // The component may have another working folder.
                 {"request", {{"folder", std::filesystem::absolute(arguments.folder).string()}}},
                 {"timeout", std::chrono::duration<double>(*duration(arguments.timeout)).count()},
                 {"full", false}});
  print(arguments.json ? answer["value"].dump() + '\n' : files_as_text(answer["value"]));
  return success;
}

struct PictureArguments {
  std::string system;
  std::string output = "map.png";
  std::string subarchitecture = "mapping";
  std::string timeout = "60s";
  bool json = false;
};

int draw_map(const PictureArguments& arguments) {
  auto answer =
    ask_for_one(choose_system(arguments.system),
                {{"do", "call"},
                 {"subarchitecture", arguments.subarchitecture},
                 {"type", "DrawMap"},
                 {"request", {{"file", std::filesystem::absolute(arguments.output).string()}}},
                 {"timeout", std::chrono::duration<double>(*duration(arguments.timeout)).count()},
                 {"full", false}});
  auto& drawn = answer["value"];
  print(arguments.json ? drawn.dump() + '\n'
                       : fmt::format("wrote {}: {}\n", drawn["file"].get<std::string>(),
                                     drawn["content"].get<std::string>()));
  return success;
}

void add_picture(CLI::App& group, Action& chosen) {
  auto arguments = std::make_shared<PictureArguments>();
  auto* draw = inspection_command(group, "picture", "draw the map with what is known of it",
                                  arguments->system);
  draw->add_option("--output", arguments->output, "the PNG file")
    ->type_name("FILE")
    ->capture_default_str();
  draw->add_option("--in", arguments->subarchitecture, "subarchitecture with a MapPainter")
    ->type_name("SUBARCHITECTURE")
    ->capture_default_str();
  draw->add_option("--timeout", arguments->timeout, "how long to wait for the picture")
    ->type_name("DURATION")
    ->check(check_duration)
    ->capture_default_str();
  add_json_flag(*draw, arguments->json);
  draw->footer("The component MapPainter draws, on its own machine: the grid, the trajectory, the "
               "navigation graph\nwith its areas in colours, people's tracks, frontiers and the "
               "planned path, as far as there are any.\n"
               "Examples: castor map picture\n"
               "          castor map picture --output building.png --json");
  on_call(*draw, chosen, arguments, draw_map);
}

} // namespace

void add_map(CLI::App& app, Action& chosen) {
  auto* command =
    app.add_subcommand("map", "write the map of a running system, check a map, find rooms in it");
  command->require_subcommand(1);
  auto arguments = std::make_shared<MapArguments>();
  auto* write = inspection_command(*command, "export", "write map files that other tools open",
                                   arguments->system);
  write->add_option("DIR", arguments->folder, "folder for the files; it is made if need be")
    ->required();
  write->add_option("--in", arguments->subarchitecture, "subarchitecture with a MapExporter")
    ->type_name("SUBARCHITECTURE")
    ->capture_default_str();
  write->add_option("--timeout", arguments->timeout, "how long to wait for the files")
    ->type_name("DURATION")
    ->check(check_duration)
    ->capture_default_str();
  add_json_flag(*write, arguments->json);
  on_call(*write, chosen, arguments, export_map);
  add_map_check(*command, chosen);
  add_map_rooms(*command, chosen);
  add_picture(*command, chosen);
  command->footer(
    "The component MapExporter writes, on its own machine: map.yaml and map.pgm (ROS's "
    "map_server),\n"
    "map.png with the path, keyframes.g2o, corrected.log (CARMEN), map.ot and map.bt "
    "(OctoMap).\n"
    "Examples: castor map export out\n"
    "          castor map export /tmp/map --in slam --json\n"
    "          castor map check out/map.yaml\n"
    "          castor map rooms out/map.yaml --picture rooms.png");
}

} // namespace castor::cli
