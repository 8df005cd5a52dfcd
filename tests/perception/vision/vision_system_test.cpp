#include "castor/tests/perception/vision/vision_system.hpp"

#include "castor/perception/vision/camera/image_source_file.hpp"

#include <algorithm>
#include <set>

namespace castor::vision {

namespace {

TEST_F(VisionSystem, SeesWhatIsOnTheTable) {
  auto system = watch(vision_cast(), {{"source", scene("red cube at -0.15 0 size 0.07 turned 20\n"
                                                       "blue square at 0 -0.1 size 0.09\n"
                                                       "green sphere at 0.15 0.05 size 0.07\n")}});
  std::set<std::string> names;
  for (auto& x : all<SceneObject>(*system)) {
    names.insert(x.label.value);
    EXPECT_EQ(x.managing_process, "segmentor");
    // Within the table, and about as large as the scene has it.
    EXPECT_LT(std::abs(x.pose.position.x), 0.25) << x.label.value;
    EXPECT_NEAR(x.box.size.x, 0.08, 0.04) << x.label.value;
    ASSERT_EQ(x.roi_ids.size(), 1u);
  }
  EXPECT_EQ(names, (std::set<std::string>{"red cube", "blue square", "green sphere"}));
  auto rois = all<ROI>(*system);
  EXPECT_EQ(rois.size(), 3u);
  for (auto& x : rois)
    EXPECT_TRUE(x.has_features);
  auto scenes = all<SceneChanged>(*system);
  ASSERT_EQ(scenes.size(), 1u);
  EXPECT_TRUE(scenes[0].changed);
  EXPECT_TRUE(scenes[0].processed);
}

TEST_F(VisionSystem, TheFileSaysHowSmallAThingMayBe) {
  auto small = scene("red cube at -0.1 0 size 0.07\nblue square at 0.1 0 size 0.012\n");
  EXPECT_EQ(all<SceneObject>(*watch(vision_cast(), {{"source", small}})).size(), 2u);
  EXPECT_EQ(
    all<SceneObject>(*watch(vision_cast(), {{"source", small}, {"min_length", "0.03"}})).size(),
    1u);
  EXPECT_EQ(
    all<SceneObject>(*watch(vision_cast(), {{"source", small}, {"min_area", "0.001"}})).size(), 1u);
}

TEST_F(VisionSystem, ObjectsStayUnknownWithoutTheRecogniser) {
  auto text = with(vision_cast(), "CPP MG recogniser", "");
  auto system = watch(text, {{"source", scene("red cube at 0 0 size 0.07\n")}});
  auto objects = all<SceneObject>(*system);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].colour.value, "unknown");
  EXPECT_EQ(objects[0].shape.value, "unknown");
}

TEST_F(VisionSystem, FollowsTheSceneAsItChanges) {
  std::vector<std::string> told;
  SystemOptions options;
  options.on_change = [&](const ChangeEvent& event) {
    if (event.type_name() == "SceneObject" && event.operation != Operation::overwrite)
      told.push_back(std::string{to_string(event.operation)});
  };
  auto system = watch(vision_cast(),
                      {{"source", scene("red cube at -0.15 0 size 0.07\n"
                                        "after 2s add yellow disc at 0.12 0 size 0.09\n"
                                        "after 4s remove red cube\n")}},
                      options, 5s);
  EXPECT_EQ(told, (std::vector<std::string>{"ADD", "ADD", "DELETE"}));
  auto objects = all<SceneObject>(*system);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].label.value, "yellow circle");
}

TEST_F(VisionSystem, WritesAnnotatedPictures) {
  watch(vision_cast(),
        {{"source", scene("red cube at 0 0 size 0.07\n")}, {"output", (folder / "out").string()}});
  auto picture = read_image(folder / "out" / "pictures-001.png");
  EXPECT_EQ(picture.width, 640u);
  EXPECT_EQ(picture.height, 480u);
}

TEST_F(VisionSystem, KeepsASmallPictureOfTheScene) {
  std::vector<ScenePicture> pictures;
  SystemOptions options;
  options.on_entry = [&](const ChangeEvent&, const EntryPtr& entry) {
    if (auto x = entry ? entry->value.as<ScenePicture>() : nullptr)
      pictures.push_back(*x);
  };
  auto system = watch(vision_cast(), {{"source", scene("red cube at 0 0 size 0.07\n")}}, options);
  ASSERT_FALSE(pictures.empty());
  EXPECT_EQ(pictures.back().image.width, 320u);
  EXPECT_EQ(pictures.back().image.height, 240u);
  EXPECT_EQ(pictures.back().image.bytes.size(), 320u * 240u * 3u);
  EXPECT_TRUE(all<ScenePicture>(*system).empty()) << "it ends with the component";
}

TEST_F(VisionSystem, AMissingPictureIsAClearFailureOfTheCamera) {
  cast::ParseOptions parse_options;
  parse_options.variables = {{"source", (folder / "none.png").string()}};
  auto parsed = cast::parse_file(CASTOR_CONFIGS "/vision.cast", parse_options);
  System system{parsed.architecture.value()};
  try {
    system.start();
    FAIL() << "it has started";
  } catch (const SystemError& e) {
    std::string message = e.what();
    EXPECT_NE(message.find("camera cannot be configured"), message.npos) << message;
    EXPECT_NE(message.find("none.png: there is no such file"), message.npos) << message;
  }
}

} // namespace

} // namespace castor::vision
