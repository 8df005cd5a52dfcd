#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/building_generator.hpp"
#include "castor/mapping/building/building_picture.hpp"
#include "castor/mapping/building/building_text.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/table.hpp"
#include "castor/tools/cli/writable.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;

struct BuildingArguments {
  std::string file;
  std::string picture;
  bool json = false;
};

struct GenerateArguments {
  mapping::GeneratorOptions options;
  std::string output;
  bool json = false;
};

/// Whether the door leads into the room: one of its sides is there.
bool leads_into(const mapping::Building& building, const mapping::Door& door,
                const mapping::Room& room) {
  const auto middle = mapping::point_at(door.opening, 0.5);
  const auto& wall = building.walls[door.wall].middle;
  const double width = mapping::length(wall);
  const mapping::Point2 across{-(wall.to.y - wall.from.y) / width,
                               (wall.to.x - wall.from.x) / width};
  constexpr double beside = 0.2; // metres
  return std::ranges::any_of(std::initializer_list<double>{beside, -beside}, [&](double d) {
    return mapping::room_at(building, {middle.x + d * across.x, middle.y + d * across.y}) == &room;
  });
}

template <class Things>
std::size_t count_in(const mapping::Building& building, const Things& things,
                     const mapping::Room& room) {
  return static_cast<std::size_t>(std::ranges::count_if(things, [&](const auto& x) {
    return mapping::room_at(building, {x.body.pose.x, x.body.pose.y}) == &room;
  }));
}

Json summary_of_building(const mapping::Building& building) {
  Json rooms = Json::array();
  double area = 0;
  for (const auto& room : building.rooms) {
    area += room.area;
    rooms.push_back({{"name", room.name},
                     {"kind", room.kind},
                     {"area", room.area},
                     {"doors", std::ranges::count_if(building.doors,
                                                     [&](const mapping::Door& x) {
                                                       return leads_into(building, x, room);
                                                     })},
                     {"furniture", count_in(building, building.furniture, room)},
                     {"objects", count_in(building, building.objects, room)}});
  }
  const auto [low, high] = mapping::extent(building);
  return {{"name", building.name},
          {"length", high.x - low.x},
          {"width", high.y - low.y},
          {"area", area},
          {"rooms", std::move(rooms)},
          {"doors", building.doors.size()},
          {"shut", std::ranges::count_if(building.doors,
                                         [](const mapping::Door& x) { return !x.is_open; })},
          {"furniture", building.furniture.size()},
          {"objects", building.objects.size()},
          {"people", building.people.size()}};
}

std::string building_as_text(const Json& building) {
  Table table({"room", "kind", ">m2", ">doors", ">furniture", ">objects"});
  for (const auto& x : building["rooms"])
    table.add({x["name"].get<std::string>(), x["kind"].get<std::string>(),
               fmt::format("{:.1f}", x["area"].get<double>()), x["doors"].dump(),
               x["furniture"].dump(), x["objects"].dump()});
  auto name = building["name"].get<std::string>();
  auto result = table.text();
  result += fmt::format("\n{}{:.1f} m x {:.1f} m, {} rooms of {:.1f} m2, {} doors ({} shut), {} "
                        "pieces of furniture, {} objects, {} people\n",
                        name.empty() ? "" : name + ": ", building["length"].get<double>(),
                        building["width"].get<double>(), building["rooms"].size(),
                        building["area"].get<double>(), building["doors"].dump(),
                        building["shut"].dump(), building["furniture"].dump(),
                        building["objects"].dump(), building["people"].dump());
  return result;
}

int generate_building(const GenerateArguments& arguments) {
  const auto building = mapping::generate_building(arguments.options);
  const auto text = mapping::building_text(building);
  if (!arguments.output.empty())
    write_file(arguments.output, text);
  if (arguments.json)
    print(summary_of_building(building).dump() + '\n');
  else
    print(arguments.output.empty() ? text : building_as_text(summary_of_building(building)));
  return success;
}

int show_building(const BuildingArguments& arguments) {
  mapping::BuildingText read;
  try {
    read = mapping::load_building(arguments.file);
  } catch (const TextFileError& e) {
    print(e.problems());
    return bad_input;
  }
  print(read.problems);
  if (!arguments.picture.empty()) {
    const auto png = mapping::picture_of(read.building);
    write_file(arguments.picture, {reinterpret_cast<const char*>(png.data()), png.size()});
  }
  const auto summary = summary_of_building(read.building);
  print(arguments.json ? summary.dump() + '\n' : building_as_text(summary));
  return success;
}

void add_generate(CLI::App& group, Action& chosen) {
  auto arguments = std::make_shared<GenerateArguments>();
  auto& options = arguments->options;
  auto* command = group.add_subcommand("generate", "make a building of rooms along a corridor");
  command->add_option("--seed", options.seed, "the same seed makes the same building")
    ->capture_default_str();
  command->add_option("--rooms", options.rooms, "rooms beside the corridor")
    ->check(CLI::Range(2, 60))
    ->capture_default_str();
  command->add_option("--walkers", options.walkers, "people who walk, at most")
    ->check(CLI::Range(0, 20))
    ->capture_default_str();
  command->add_option("--output", arguments->output, "write the building to this file")
    ->type_name("FILE")
    ->check(check_output_file);
  add_json_flag(*command, arguments->json);
  command->footer(
    "Prints the building's file, or with --output or --json, what is in it. Some doors are shut; a "
    "robot of\n0.25 m radius gets through all others, and around the furniture.\n"
    "Examples: castor building generate --seed 7 --output seven.building\n"
    "          castor building generate --rooms 12 --json");
  on_call(*command, chosen, arguments, generate_building);
}

} // namespace

void add_building(CLI::App& app, Action& chosen) {
  auto* group =
    app.add_subcommand("building", "look at the buildings that robots are simulated in");
  group->require_subcommand(1);
  auto arguments = std::make_shared<BuildingArguments>();
  auto* command = group->add_subcommand("show", "check a building's file, and describe it");
  command->add_option("FILE", arguments->file, "the building's file")->type_name("")->required();
  command->add_option("--picture", arguments->picture, "draw a plan into this PNG file")
    ->type_name("FILE")
    ->check(check_output_file);
  add_json_flag(*command, arguments->json);
  command->footer(
    "Prints the rooms with their areas, doors, furniture and objects. All problems of the file are "
    "printed\nwith their lines and what to do; with an error, the exit status is 2.\n"
    "Examples: castor building show configs/buildings/office.building\n"
    "          castor building show configs/buildings/office.building --picture office.png");
  on_call(*command, chosen, arguments, show_building);
  add_generate(*group, chosen);
}

} // namespace castor::cli
