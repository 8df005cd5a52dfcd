#include "castor/tools/chaos/scene_text.hpp"

#include <gmock/gmock.h>

namespace castor::faults {

namespace {

using testing::ElementsAre;

constexpr const char* table = "# A table at rest.\n"
                              "table wood\n"
                              "camera 0 -0.62 0.55  looking-at 0 0 0\n"
                              "Red Sphere  at 0.05 0.07  size 0.07  # the ball\n"
                              "#ff8000 box at 0 0\n"
                              "green cube at 0.2 0.2 turned 3 name=Mug\n"
                              "after 2s add blue cube at 0 0\n";

TEST(SceneText, KnowsTheThingsOnTheTable) {
  SceneText scene{table};
  EXPECT_THAT(scene.things(), ElementsAre("red sphere", "#ff8000 box", "mug"));
  EXPECT_TRUE(scene.has("RED sphere"));
  EXPECT_TRUE(scene.has("mug"));
  EXPECT_TRUE(scene.has("green cube"));
  EXPECT_FALSE(scene.has("blue cube"));
  EXPECT_FALSE(scene.has(""));
  EXPECT_EQ(scene.text(), table);
}

TEST(SceneText, AThingThatIsMovedKeepsWhatElseIsSaidOfIt) {
  SceneText scene{"red sphere  at 0.05 0.07  size 0.07  # the ball\nlight 1 1 1\n"};
  scene.move("red sphere", "0.1", "-2cm");
  EXPECT_EQ(scene.text(), "red sphere at 0.1 -2cm size 0.07\nlight 1 1 1\n");
  scene.move("blue sphere", "0", "0");
  EXPECT_EQ(scene.text(), "red sphere at 0.1 -2cm size 0.07\nlight 1 1 1\n");
}

TEST(SceneText, ThingsComeAndGoAsOftenAsOneLikes) {
  SceneText scene{"light 1 1 1\n"};
  scene.remove("mug");
  scene.add("red cube", "0 0 name=mug");
  scene.add("red cube", "0 1 name=mug");
  EXPECT_EQ(scene.text(), "light 1 1 1\nred cube at 0 1 name=mug\n");
  scene.remove("mug");
  EXPECT_EQ(scene.text(), "light 1 1 1\n");
}

} // namespace

} // namespace castor::faults
