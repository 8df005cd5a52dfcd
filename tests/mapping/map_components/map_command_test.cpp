// castor map, on a running system.

#include "castor/tests/support/eventually.hpp"
#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::HasSubstr;

class MapCommand : public Castor {
protected:
  /// One keyframe that sees a wall 2 m ahead, and one on its right.
  static std::string keyframe() {
    json pose{{"x", 0}, {"y", 0}, {"heading", 0}};
    json scan{{"time", 0},           {"mount", pose},  {"first_angle", -1.5707963267948966},
              {"angle_step", 0.785}, {"max_range", 8}, {"ranges", {1.0, 2.8, 2.0}}};
    return json{
      {"number", 0}, {"time", 0}, {"odometry", pose}, {"local_pose", pose}, {"scan", scan}}
      .dump();
  }
};

TEST_F(MapCommand, ExportsTheMapOfARunningSystem) {
  auto output = folder / "output";
  Process castor{command({"run",
                          system("CPP UM grid GridBuilder\nCPP UM octree OctreeBuilder\n"
                                 "CPP UM exporter MapExporter --output \"%(output)\"\n"),
                          "--output", output.string()})};
  ASSERT_TRUE(eventually([&] { return ask({"wm", "ls"}).status == 0; }));
  auto added = ask({"wm", "add", "a", "Keyframe", keyframe()});
  ASSERT_EQ(added.status, 0) << added.errors;
  ASSERT_TRUE(eventually([&] {
    auto entries = ask({"wm", "ls", "a"}).output;
    return entries.find("GridTile") != entries.npos && entries.find("OctreeBlock") != entries.npos;
  }));
  auto exported = folder / "exported";
  auto answer = ask({"map", "export", exported.string(), "--in", "a"});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("wrote " + (exported / "map.yaml").string() + "\n"));
  for (auto* name :
       {"map.yaml", "map.pgm", "map.png", "keyframes.g2o", "corrected.log", "map.ot", "map.bt"})
    EXPECT_TRUE(exists(exported / name)) << name;
  EXPECT_EQ(read(exported / "keyframes.g2o"), "VERTEX_SE2 0 0 0 0\nFIX 0\n");
  auto as_json = ask({"map", "export", exported.string(), "--in", "a", "--json"});
  EXPECT_EQ(json::parse(as_json.output)["files"].size(), 7U);
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_TRUE(exists(output / "map.yaml"));
}

TEST_F(MapCommand, WithoutAnExporterSaysSo) {
  Process castor{command({"run", system("CPP UM grid GridBuilder\n")})};
  ASSERT_TRUE(eventually([&] { return ask({"wm", "ls"}).status == 0; }));
  auto answer = ask({"map", "export", (folder / "exported").string(), "--in", "a"});
  EXPECT_NE(answer.status, 0);
  EXPECT_THAT(answer.errors, HasSubstr("no component of a serves calls"));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0);
}

/// A map of two rooms of 3 m by 3 m with a door of 1 m between them.
std::string two_rooms(const std::filesystem::path& folder) {
  std::string pixels;
  for (int row = 0; row < 80; ++row)
    for (int column = 0; column < 144; ++column) {
      auto room = row >= 10 && row < 70 && column >= 10 && column < 134;
      auto wall = column >= 70 && column < 74 && (row < 30 || row >= 50);
      pixels.push_back(static_cast<char>(room && !wall ? 254 : 0));
    }
  std::ofstream(folder / "map.pgm", std::ios::binary) << "P5\n144 80\n255\n" << pixels;
  std::ofstream(folder / "map.yaml")
    << "image: map.pgm\nresolution: 0.05\norigin: [-1, 2, 0]\nnegate: 0\n"
       "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  return (folder / "map.yaml").string();
}

TEST_F(MapCommand, FindsTheRoomsOfAMapInFiles) {
  auto picture = folder / "rooms.png";
  auto found = ask({"map", "rooms", two_rooms(folder), "--picture", picture.string()});
  EXPECT_EQ(found.status, 0) << found.errors;
  EXPECT_THAT(found.output, HasSubstr("2 rooms of 18.2 m2, 1 openings"));
  EXPECT_THAT(read(picture), HasSubstr("PNG"));
  auto answer = json::parse(ask({"map", "rooms", two_rooms(folder), "--json"}).output);
  ASSERT_EQ(answer["rooms"].size(), 2U);
  EXPECT_EQ(answer["rooms"][0]["neighbours"], json::array({2}));
  EXPECT_NEAR(answer["rooms"][0]["centre"]["x"].get<double>(), 1, 0.2);
  EXPECT_NEAR(answer["rooms"][0]["centre"]["y"].get<double>(), 4, 0.2);
  ASSERT_EQ(answer["openings"].size(), 1U);
  EXPECT_NEAR(answer["openings"][0]["width"].get<double>(), 1, 0.11);
}

TEST_F(MapCommand, RoomsOfAFileThatIsNotThereAreAnError) {
  auto answer = ask({"map", "rooms", (folder / "none.yaml").string()});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, HasSubstr("none.yaml"));
}

TEST_F(MapCommand, ChecksAMapFile) {
  std::ofstream{folder / "map.pgm"} << "P2\n4 2\n255\n254 254 254 0\n205 205 0 0\n";
  std::ofstream{folder / "map.yaml"} << "image: map.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\n"
                                        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  auto yaml = (folder / "map.yaml").string();
  auto answer = ask({"map", "check", yaml});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("4 x 2 cells of 0.5 m, 2.0 m x 1.0 m"));
  EXPECT_THAT(answer.output, HasSubstr("37.5 % occupied, 37.5 % free (0.8 m2), 25.0 % unknown"));
  EXPECT_EQ(answer.errors, "");
  auto as_json = json::parse(ask({"map", "check", yaml, "--json"}).output);
  EXPECT_EQ(as_json["cells"]["occupied"], 3);
  EXPECT_EQ(as_json["cells"]["unknown"], 2);
  EXPECT_EQ(as_json["origin"]["y"], 2);
}

TEST_F(MapCommand, SaysAllThatIsWrongWithAMapFile) {
  std::ofstream{folder / "map.yaml"} << "image: none.pgm\nresolution: -1\norigin: [0, 0]\n"
                                        "negate: 0\noccupied_thresh: 0.2\nfree_thresh: 0.6\n";
  auto yaml = (folder / "map.yaml").string();
  auto answer = ask({"map", "check", yaml});
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(answer.output, "");
  EXPECT_THAT(answer.errors, HasSubstr("map.yaml:2"));
  EXPECT_THAT(answer.errors, HasSubstr("the resolution is not a number above 0"));
  EXPECT_THAT(answer.errors, HasSubstr("map.yaml:3"));
  EXPECT_THAT(answer.errors, HasSubstr("map.yaml:5"));
  EXPECT_THAT(answer.errors, HasSubstr("is not above free_thresh"));
  std::ofstream{folder / "map.yaml"} << "image: none.pgm\nresolution: 1\norigin: [0, 0, 0]\n"
                                        "negate: 0\noccupied_thresh: 0.6\nfree_thresh: 0.2\n";
  auto without_image = ask({"map", "check", yaml});
  EXPECT_EQ(without_image.status, 2);
  EXPECT_THAT(without_image.errors, HasSubstr("map.yaml:1"));
  EXPECT_THAT(without_image.errors, HasSubstr("there is no such file"));
  EXPECT_EQ(ask({"map", "check", (folder / "none.yaml").string(), "--json"}).status, 2);
}

TEST_F(MapCommand, WarnsOfAMapThatNoRobotCanBeIn) {
  std::ofstream{folder / "map.pgm"} << "P2\n2 1\n255\n0 205\n";
  std::ofstream{folder / "map.yaml"} << "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0.5]\n"
                                        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  auto answer = ask({"map", "check", (folder / "map.yaml").string()});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.errors, HasSubstr("no cell is free"));
  EXPECT_THAT(answer.errors, HasSubstr("the map is turned"));
}

} // namespace

} // namespace castor::test
