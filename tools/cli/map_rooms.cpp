#include "castor/mapping/maps/map_file_error.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/rooms/room_segmentation.hpp"
#include "castor/mapping/rooms/rooms_picture.hpp"
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
#include <memory>
#include <stdexcept>
#include <string>

namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;

struct MapRoomsArguments {
  std::string file;
  std::string picture;
  bool json = false;
  mapping::RoomOptions options;
};

Json as_json(const mapping::Point2& x) {
  return {{"x", x.x}, {"y", x.y}};
}

Json as_json(const mapping::SegmentedRooms& found) {
  Json rooms = Json::array();
  for (const auto& x : found.rooms) {
    Json outline = Json::array();
    for (const auto& corner : x.outline)
      outline.push_back(as_json(corner));
    rooms.push_back({{"number", x.number},
                     {"area", x.area},
                     {"centre", as_json(x.centre)},
                     {"clearance", x.clearance},
                     {"neighbours", x.neighbours},
                     {"outline", std::move(outline)}});
  }
  Json openings = Json::array();
  for (const auto& x : found.openings)
    openings.push_back({{"a", x.a},
                        {"b", x.b},
                        {"from", as_json(x.from)},
                        {"to", as_json(x.to)},
                        {"width", x.width}});
  return {{"rooms", std::move(rooms)}, {"openings", std::move(openings)}};
}

std::string as_text(const mapping::SegmentedRooms& found) {
  Table rooms({">room", ">m2", ">x", ">y", ">clearance", "neighbours"});
  double area = 0;
  for (const auto& x : found.rooms) {
    area += x.area;
    rooms.add({std::to_string(x.number), fmt::format("{:.1f}", x.area),
               fmt::format("{:.2f}", x.centre.x), fmt::format("{:.2f}", x.centre.y),
               fmt::format("{:.2f}", x.clearance),
               fmt::format("{}", fmt::join(x.neighbours, " "))});
  }
  return rooms.text() + fmt::format("\n{} rooms of {:.1f} m2, {} openings\n", found.rooms.size(),
                                    area, found.openings.size());
}

int show_rooms(const MapRoomsArguments& arguments) {
  mapping::CellMap map;
  try {
    map = mapping::read_map_server(arguments.file);
  } catch (const mapping::MapFileError& e) {
    print(e.problems());
    return bad_input;
  }
  const auto found = mapping::segment_rooms(map, arguments.options);
  if (!arguments.picture.empty()) {
    const auto png = mapping::picture_of(map, found);
    write_file(arguments.picture, {reinterpret_cast<const char*>(png.data()), png.size()});
  }
  print(arguments.json ? as_json(found).dump() + '\n' : as_text(found));
  return success;
}

} // namespace

void add_map_rooms(CLI::App& group, Action& chosen) {
  auto arguments = std::make_shared<MapRoomsArguments>();
  auto& options = arguments->options;
  auto* command = group.add_subcommand("rooms", "find the rooms of a map in files");
  command->add_option("FILE", arguments->file, "the .yaml of a map of ROS's map_server")
    ->type_name("")
    ->required();
  command->add_option("--picture", arguments->picture, "draw the rooms into this PNG file")
    ->type_name("FILE")
    ->check(check_output_file);
  command
    ->add_option("--neck", options.neck_ratio,
                 "openings narrower than this share of the lesser room's width divide")
    ->type_name("SHARE")
    ->check(CLI::Range(0.1, 1.0))
    ->capture_default_str();
  command
    ->add_option("--furniture", options.largest_furniture,
                 "diagonal up to which what stands alone is furniture, metres")
    ->type_name("METRES")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command->add_option("--smallest", options.smallest_room, "area of the smallest room, m2")
    ->type_name("M2")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  add_json_flag(*command, arguments->json);
  on_call(*command, chosen, arguments, show_rooms);
  command->footer(
    "Prints each room with its area, its place farthest from walls, and the rooms that openings "
    "lead to.\nProblems of the file are printed with what to do; the exit status is then 2.\n"
    "Examples: castor map rooms out/map.yaml\n"
    "          castor map rooms out/map.yaml --picture rooms.png --json");
}

} // namespace castor::cli
