#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_check.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_names.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

using namespace std::chrono_literals;

TabletopScene scene_of(const std::string& text) {
  auto result = parse_tabletop_scene(text, "test.scene");
  EXPECT_FALSE(has_errors(result.problems)) << render(result.problems);
  return result.scene;
}

std::string problems_of(const std::string& text) {
  return render(parse_tabletop_scene(text, "test.scene").problems);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(TabletopScene, IsReadFromAFewLines) {
  const auto scene = scene_of("# blue square and friends\n"
                              "table wood\n"
                              "camera 0 -0.9 0.7  looking-at 0 0 0  fov 45\n"
                              "light -1 -1 2\n"
                              "noise 3\n"
                              "seed 7\n"
                              "Red Cube      at 0.10 0.05  size 0.06  turned 30\r\n"
                              "#2040b0 square at -0.1 0.0   size 8cm   # on the left\n"
                              "green can at 0 20cm size 50mm 0.08 name=mug\n");
  EXPECT_EQ(scene.camera, look_at({0, -0.9, 0.7}, {0, 0, 0}, 45, 640, 480, "table"));
  EXPECT_EQ(scene.setting.noise, 3);
  EXPECT_EQ(scene.setting.seed, 7U);
  const auto objects = scene.at(0s).objects;
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_EQ(objects[0].shape, TabletopShape::cube);
  EXPECT_EQ(objects[0].colour_name, "red");
  EXPECT_EQ(objects[0].x, 0.10);
  EXPECT_EQ(objects[0].size, (Point3{0.06, 0.06, 0.06}));
  EXPECT_EQ(objects[0].turned_degrees, 30);
  EXPECT_EQ(objects[1].colour, (SceneColour{0x20, 0x40, 0xB0}));
  EXPECT_NEAR(objects[1].size.x, 0.08, 1e-12);
  EXPECT_EQ(objects[2].name, "mug");
  EXPECT_NEAR(objects[2].size.z, 0.08, 1e-12);
}

TEST(TabletopScene, HasASettingWithoutASingleLine) {
  const auto scene = scene_of("");
  Camera expected = nominal_camera(640, 480);
  expected.is_assumed = false;
  EXPECT_EQ(scene.camera, expected);
  EXPECT_EQ(scene.setting, TabletopSnapshot{});
  EXPECT_EQ(scene.change_times(), std::vector<SceneTime>{0s});
}

TEST(TabletopScene, HasTablesOfManyLooks) {
  using Material = TableLook::Material;
  EXPECT_EQ(scene_of("table wood").setting.table.material, Material::wood);
  EXPECT_EQ(scene_of("table cloth").setting.table.material, Material::cloth);
  EXPECT_EQ(scene_of("table grey").setting.table.material, Material::plain);
  const auto table = scene_of("table green cloth size 1.2 0.8").setting.table;
  EXPECT_EQ(table.material, Material::cloth);
  EXPECT_EQ(table.colour, *colour_named("green"));
  EXPECT_EQ(table.width, 1.2);
  EXPECT_EQ(table.depth, 0.8);
}

TEST(TabletopScene, ChangesOverTime) {
  const auto scene = scene_of("red cube at 0 0\n"
                              "after 4s remove green sphere\n"
                              "after 1s add green sphere at 0.2 0.1\n"
                              "after 2s move red cube to -0.2 0.1 over 1s\n"
                              "after 500ms move red cube to 0.1 0\n");
  EXPECT_EQ(scene.at(0s).objects.size(), 1U);
  EXPECT_EQ(scene.at(999ms).objects.size(), 1U);
  EXPECT_EQ(scene.at(1s).objects.size(), 2U);
  EXPECT_EQ(scene.at(4s).objects.size(), 1U);
  EXPECT_EQ(scene.at(499ms).objects[0].x, 0);
  EXPECT_EQ(scene.at(500ms).objects[0].x, 0.1);
  EXPECT_NEAR(scene.at(2500ms).objects[0].x, -0.05, 1e-12);
  EXPECT_NEAR(scene.at(2500ms).objects[0].y, 0.05, 1e-12);
  EXPECT_EQ(scene.at(1h).objects[0].x, -0.2);
  EXPECT_EQ(scene.at(-1s), scene.at(0s));
  EXPECT_EQ(scene.change_times(), (std::vector<SceneTime>{0s, 500ms, 1s, 2s, 3s, 4s}));
}

TEST(TabletopScene, LetsAMoveBeInterrupted) {
  const auto scene = scene_of("red cube at 0 0\n"
                              "after 0s move red cube to 0.4 0 over 4s\n"
                              "after 2s move red cube to 0.2 0.2 over 1s\n");
  EXPECT_NEAR(scene.at(2s).objects[0].x, 0.2, 1e-12);
  EXPECT_NEAR(scene.at(2500ms).objects[0].y, 0.1, 1e-12);
  EXPECT_NEAR(scene.at(10s).objects[0].x, 0.2, 1e-12);
}

TEST(TabletopScene, RefersToObjectsAsTheyAreThen) {
  const auto scene = scene_of("red cube at 0 0\n"
                              "after 1s remove red cube\n"
                              "after 2s add red cube at 0.1 0.1\n"
                              "after 3s move red cube to 0.2 0.1\n");
  EXPECT_TRUE(scene.at(1500ms).objects.empty());
  EXPECT_EQ(scene.at(3s).objects[0].x, 0.2);
}

TEST(SceneProblems, ComeAllAtOnceAndByLine) {
  const auto [scene, problems] = parse_tabletop_scene("tabel wood\n"
                                                      "bleu square at 0 0\n"
                                                      "red squar at 0 0\n"
                                                      "red cube\n"
                                                      "red cube at 0 zero\n"
                                                      "red cube at 0 0 size 6\n"
                                                      "after 2 add red cube at 0 0\n"
                                                      "after 2s ad red cube at 0 0\n"
                                                      "camera 0 -1 -1\n"
                                                      "noise 1000\n"
                                                      "seed 1\n"
                                                      "seed 2\n",
                                                      "test.scene");
  ASSERT_EQ(problems.size(), 11U) << render(problems);
  const std::vector<std::string> remedies{"'table'", "'blue'",      "'square'", "\"at\"",
                                          "length",  "centimetres", "2s",       "'add'"};
  for (std::size_t i = 0; i < problems.size(); ++i) {
    EXPECT_EQ(problems[i].where.file(), "test.scene");
    EXPECT_EQ(problems[i].where.line(), i < 10 ? i + 1 : 12);
    EXPECT_FALSE(problems[i].line.empty());
    if (i < remedies.size()) {
      EXPECT_TRUE(contains(problems[i].remedy, remedies[i])) << render(problems[i]);
    }
  }
}

TEST(SceneProblems, AreFoundInEventsWithoutObject) {
  EXPECT_TRUE(contains(problems_of("red cube at 0 0\nafter 1s remove red sphere"),
                       "There are then: red cube."));
  EXPECT_TRUE(
    contains(problems_of("red cube at 0 0 name=mug\nafter 1s remove mgu"), "did you mean 'mug'?"));
  EXPECT_TRUE(contains(problems_of("after 1s remove mug"), "The table is empty then"));
  EXPECT_TRUE(contains(problems_of("red cube at 0 0\nred cube at 0.2 0\nafter 1s remove red cube"),
                       "there are 2 objects"));
  // The line that brings the object is wrong itself; that is told only once.
  EXPECT_EQ(parse_tabletop_scene("red cube att 0 0\nafter 1s remove red cube", "").problems.size(),
            1U);
}

TEST(SceneProblems, AreFoundInNames) {
  EXPECT_TRUE(contains(problems_of("red cube at 0 0 name=red"), "is no name"));
  EXPECT_TRUE(contains(problems_of("red cube at 0 0 name="), "is no name"));
  EXPECT_TRUE(contains(problems_of("red cube at 0 0 name=a\nred cube at 0.2 0 name=a"),
                       "there already is an object named \"a\", in line 1"));
}

TEST(SceneProblems, AreObjectsInOnePlace) {
  const auto problems =
    parse_tabletop_scene("red cube at 0 0\nblue cube at 0.03 0.03", "").problems;
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].severity, Severity::error);
  EXPECT_EQ(problems[0].where.line(), 2U);
  EXPECT_EQ(problems_of("red cube at 0 0 size 0.06\nblue cube at 0.061 0 size 0.06"), "");
  EXPECT_TRUE(contains(problems_of("red cube at 0 0 size 0.06 turned 45\n"
                                   "blue cube at 0.065 0 size 0.06"),
                       "the blue cube overlaps the red cube"));
}

TEST(SceneProblems, AreCollisionsOnTheWay) {
  const auto problems = parse_tabletop_scene("red cube at -0.2 0\n"
                                             "blue cube at 0 0\n"
                                             "after 1s move red cube to 0.2 0 over 2s",
                                             "")
                          .problems;
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].severity, Severity::warning);
  EXPECT_TRUE(contains(problems[0].message, "moves through the blue cube"));
}

TEST(SceneProblems, AreObjectsBesideTheTableOrOutOfSight) {
  EXPECT_TRUE(
    contains(problems_of("red cube at 1.2 0"), "error: the red cube is not on the table"));
  EXPECT_TRUE(contains(problems_of("red cube at 0.99 0"), "warning: the red cube sticks out"));
  EXPECT_TRUE(contains(problems_of("red cube at 0.9 -0.5"), "warning: the camera does not see"));
  EXPECT_TRUE(
    contains(problems_of("red cube at 0 0\nafter 1s move red cube to 0 3"), "is not on the table"));
}

TEST(SceneFile, IsLoadedOrSaysWhy) {
  EXPECT_THROW(load_tabletop_scene("no-such.scene"), TextFileError);
}

TEST(SceneFile, IsSoundInEachOfTheScenesThatComeWithTheSystem) {
  const auto scenes = std::filesystem::path(CASTOR_CONFIGS) / "scenes";
  for (const std::string name : {"playmate", "table", "blue-square", "changing"}) {
    const auto [scene, problems] = load_tabletop_scene(scenes / (name + ".scene"));
    EXPECT_EQ(render(problems), "");
    EXPECT_FALSE(scene.actors.empty());
  }
}

TEST(ObjectGeometry, HasFootprintsAndBoxes) {
  TabletopObject cube;
  cube.x = 0.1;
  cube.size = {0.06, 0.06, 0.06};
  cube.turned_degrees = 45;
  const auto box = bounding_box(cube);
  EXPECT_NEAR(box.size.x, 0.06 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(box.size.z, 0.06, 1e-12);
  EXPECT_NEAR(box.centroid.x, 0.1, 1e-12);
  EXPECT_NEAR(box.centroid.z, 0.03, 1e-12);

  TabletopObject triangle;
  triangle.shape = TabletopShape::triangle;
  triangle.size = size_of(TabletopShape::triangle, {0.09});
  const auto corners = footprint(triangle);
  ASSERT_EQ(corners.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % 3];
    EXPECT_NEAR(std::hypot(a.x - b.x, a.y - b.y), 0.09, 1e-12);
  }
  EXPECT_NEAR(corners[0].y + corners[1].y + corners[2].y, 0, 1e-12);
}

TEST(SceneNames, HaveDefaultSizes) {
  EXPECT_EQ(size_of(TabletopShape::rectangle, {0.12}).y, 0.06);
  EXPECT_EQ(size_of(TabletopShape::box, {0.12, 0.05}).z, 0.05);
  EXPECT_EQ(size_of(TabletopShape::disc, {}).z, 0.005);
  for (const auto& name : shape_names())
    EXPECT_TRUE(shape_named(name));
  for (const auto& name : colour_names())
    EXPECT_TRUE(colour_named(name));
  EXPECT_FALSE(colour_named("#12345"));
  EXPECT_FALSE(colour_named("#12345g"));
  EXPECT_FALSE(colour_named("#-12345"));
}

TEST(SceneProperties, NoTextBreaksTheReader) {
  const std::vector<std::string> words{
    "red",    "cube", "at",    "0",    "0.1",    "size",   "after",     "2s", "add",
    "remove", "move", "to",    "over", "camera", "light",  "\n",        "\n", "name=x",
    "x",      "#",    "table", "wood", "-1e9",   "turned", "looking-at"};
  EXPECT_TRUE(rc::check([&] {
    const auto picked = *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(words));
    std::string text;
    for (const auto& word : picked)
      text += word + " ";
    const auto result = parse_tabletop_scene(text, "any");
    for (const auto& problem : result.problems)
      RC_ASSERT(!problem.remedy.empty());
    result.scene.at(3s);
  }));
  EXPECT_TRUE(rc::check([](const std::string& text) { parse_tabletop_scene(text, "any"); }));
}

TEST(SceneProperties, ObjectsOnAGridNeverOverlap) {
  EXPECT_TRUE(rc::check([] {
    const auto count = *rc::gen::inRange(1, 10);
    std::string text = "camera 0 0 2 fov 90\n";
    for (int i = 0; i < count; ++i) {
      const auto shape = *rc::gen::elementOf(shape_names());
      const auto colour = *rc::gen::elementOf(colour_names());
      const auto turn = *rc::gen::inRange(-360, 361);
      text += colour + " " + shape + " at " + std::to_string(-0.4 + 0.2 * (i % 5)) + " " +
              std::to_string(0.2 * (i / 5)) + " turned " + std::to_string(turn) + "\n";
    }
    const auto result = parse_tabletop_scene(text, "grid");
    RC_ASSERT(render(result.problems) == "");
    RC_ASSERT(result.scene.at(0s).objects.size() == static_cast<std::size_t>(count));
  }));
}

TEST(SceneProperties, OverlapIsSymmetric) {
  EXPECT_TRUE(rc::check([] {
    const auto object = [] {
      TabletopObject result;
      result.shape = *shape_named(*rc::gen::elementOf(shape_names()));
      result.size = size_of(result.shape, {});
      result.x = *rc::gen::inRange(-10, 11) / 100.0;
      result.y = *rc::gen::inRange(-10, 11) / 100.0;
      result.turned_degrees = *rc::gen::inRange(0, 360);
      return result;
    };
    const auto a = object();
    const auto b = object();
    RC_ASSERT(overlap(a, b) == overlap(b, a));
    RC_ASSERT(overlap(a, a));
  }));
}

} // namespace

} // namespace castor::vision
