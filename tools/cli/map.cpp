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

} // namespace

void add_map(CLI::App& app, Action& chosen) {
  auto* command =
    app.add_subcommand("map", "write the map of a running system, find rooms in a map");
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
  add_map_rooms(*command, chosen);
  command->footer(
    "The component MapExporter writes, on its own machine: map.yaml and map.pgm (ROS's "
    "map_server),\n"
    "map.png with the path, keyframes.g2o, corrected.log (CARMEN), map.ot and map.bt "
    "(OctoMap).\n"
    "Examples: castor map export out\n"
    "          castor map export /tmp/map --in slam --json\n"
    "          castor map rooms out/map.yaml --picture rooms.png");
}

} // namespace castor::cli
