// The vision subarchitecture with a tracker in it.

#include "castor/tests/perception/vision/vision_system.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/scene_object_changes.hpp"
#include "castor/perception/vision/tracking/moved_object.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace castor::vision {

using namespace geometry;

namespace {

constexpr auto tracker_line = "CPP UM tracker ObjectTracker";

using ObjectTrackerSystem = VisionSystem;

TEST_F(ObjectTrackerSystem, KeepsObjectsThroughFastMotion) {
  std::vector<std::string> told;
  std::size_t overwrites = 0;
  std::size_t moves = 0;
  std::size_t updates = 0;
  std::size_t additions = 0;
  SystemOptions options;
  options.on_change = [&](const ChangeEvent& event) {
    updates += event.type_name() == "SceneObjectUpdate";
    if (event.type_name() != "SceneObject")
      return;
    if (event.operation != Operation::overwrite) {
      told.push_back(std::string{to_string(event.operation)});
      additions += event.operation == Operation::add;
      return;
    }
    ++overwrites;
    if (event.source != "tracker")
      return;
    moves += event.has_changed(&SceneObject::pose);
    for (auto& field : event.changed_fields())
      EXPECT_TRUE((std::set<std::string>{"time", "box", "pose", "managing_process"}.count(field)))
        << field;
  };
  auto system = watch(vision_cast(),
                      {{"tracker", "yes"},
                       {"source", scene("red cube at -0.15 0.05 size 0.07\n"
                                        "blue sphere at 0 -0.1 size 0.07\n"
                                        "after 2s move red cube to 0.2 0.05 over 400ms\n"
                                        "after 3s move blue sphere to -0.2 0.1\n")}},
                      options, 2500ms);
  EXPECT_EQ(told, (std::vector<std::string>{"ADD", "ADD"}));
  EXPECT_GE(moves, 2u);
  EXPECT_EQ(updates, overwrites + additions);
  std::map<std::string, Point3> places;
  for (auto& x : all<SceneObject>(*system)) {
    places[x.label.value] = x.pose.position;
    EXPECT_EQ(x.managing_process, "segmentor") << "the tracker has ended";
  }
  ASSERT_EQ(places.count("red cube"), 1u);
  EXPECT_NEAR(places["red cube"].x, 0.2, 0.03);
  EXPECT_NEAR(places["red cube"].y, 0.05, 0.03);
  ASSERT_EQ(places.count("blue sphere"), 1u);
  EXPECT_NEAR(places["blue sphere"].x, -0.2, 0.03);
  EXPECT_NEAR(places["blue sphere"].y, 0.1, 0.03);
}

TEST_F(ObjectTrackerSystem, LeavesItToTheSegmentorToDeleteWhatIsLost) {
  std::vector<std::string> deleted_by;
  SystemOptions options;
  options.on_change = [&](const ChangeEvent& event) {
    if (event.operation == Operation::remove && event.type_name() != type_name<ScenePicture>())
      deleted_by.push_back(event.type_name() + " by " + event.source);
  };
  auto system = watch(vision_cast(),
                      {{"tracker", "yes"},
                       {"source", scene("red cube at -0.15 0 size 0.07\n"
                                        "blue sphere at 0.1 0 size 0.07\n"
                                        "after 2s remove red cube\n")}},
                      options, 2500ms);
  std::sort(deleted_by.begin(), deleted_by.end());
  EXPECT_EQ(deleted_by, (std::vector<std::string>{"ROI by segmentor", "SceneObject by segmentor"}));
  auto objects = all<SceneObject>(*system);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].label.value, "blue sphere");
}

TEST_F(ObjectTrackerSystem, ChangesNothingInAStillScene) {
  auto things = scene("red cube at -0.15 0 size 0.07 turned 20\n"
                      "blue square at 0 -0.1 size 0.09\n"
                      "green sphere at 0.15 0.05 size 0.07\n");
  auto seen = [&](const std::string& tracker) {
    std::map<std::string, Point3> result;
    for (auto& x :
         all<SceneObject>(*watch(vision_cast(), {{"tracker", tracker}, {"source", things}})))
      result[x.label.value] = x.pose.position;
    return result;
  };
  auto without = seen("no");
  auto with_tracker = seen("yes");
  EXPECT_EQ(without.size(), 3u);
  ASSERT_EQ(with_tracker.size(), without.size());
  for (auto& [name, place] : without) {
    ASSERT_EQ(with_tracker.count(name), 1u) << name;
    EXPECT_NEAR(with_tracker[name].x, place.x, 0.005) << name;
    EXPECT_NEAR(with_tracker[name].y, place.y, 0.005) << name;
  }
}

/// Takes over every object, and never looks at one again.
class Keeper final : public UnmanagedComponent {
  void start() override {
    on_change(added<SceneObject>(), [this](const ChangeEvent& event) {
      for (;;) {
        auto object = *read<SceneObject>(event.address);
        object.managing_process = component_name();
        try {
          overwrite(event.address, object);
          return;
        } catch (const ConsistencyException&) {
          debug("once more");
        }
      }
    });
  }
};

CASTOR_COMPONENT(Keeper, "for tests: takes over every object")

TEST_F(ObjectTrackerSystem, NobodyElseDeletesWhatSomebodyHasTakenOver) {
  std::vector<std::string> told;
  SystemOptions options;
  options.on_change = [&](const ChangeEvent& event) {
    if (event.type_name() == "SceneObject" && event.operation != Operation::overwrite)
      told.push_back(std::string{to_string(event.operation)});
  };
  auto system = watch(vision_cast() + "\nCPP UM keeper Keeper\n",
                      {{"source", scene("red cube at -0.15 0.05 size 0.07\n"
                                        "blue sphere at 0 -0.1 size 0.07\n"
                                        "after 2s move red cube to 0.2 0.05\n"
                                        "after 2s remove blue sphere\n")}},
                      options, 2500ms);
  EXPECT_EQ(told, (std::vector<std::string>{"ADD", "ADD"}));
  std::map<std::string, Point3> places;
  for (auto& x : all<SceneObject>(*system))
    places[x.label.value] = x.pose.position;
  ASSERT_EQ(places.count("red cube"), 1u);
  EXPECT_NEAR(places["red cube"].x, 0.2, 0.03) << "the segmentor knows it by its looks";
  EXPECT_EQ(places.count("blue sphere"), 1u);
}

/// Keeps the recogniser busy while something moves: each round it gives the region another colour.
/// Fails if one is lost that it, or the recogniser, has written.
class ColourChanger final : public UnmanagedComponent {
  void run() override {
    while (sleep_for(2ms)) {
      try {
        change();
      } catch (const DoesNotExistOnWM&) {
        throw std::runtime_error("the object was deleted");
      } catch (const ConsistencyException&) {
        continue; // the tracker has moved the region
      }
      if (rounds_ >= 300 && moves_ >= 10 && named_ >= 50)
        end_system(0, "done");
    }
  }

  void change() {
    auto rois = read_all<ROI>();
    if (rois.size() != 1 || !rois[0]->has_features)
      return;
    auto object = read<SceneObject>(here(rois[0]->object_id));
    auto x = object->pose.position.x;
    moves_ += x != x_;
    x_ = x;
    auto number = object->colour.confidence;
    if (object->managing_process != "tracker" || object->colour.value == "unknown")
      return;
    // Others are of a new view, if the segmentor has taken the scene to be still.
    auto& colour = rois[0]->features.colours.front();
    if (colour.value == "many" && colour.confidence != rounds_)
      throw std::runtime_error("the region has lost a colour");
    if (object->colour.value == "many") {
      if (number < recognised_)
        throw std::runtime_error("the object has lost a colour");
      named_ += number > recognised_;
      recognised_ = number;
    }
    auto roi = *rois[0];
    roi.features.colours = {{"many", static_cast<double>(rounds_ + 1)}};
    overwrite(rois[0].address, std::move(roi));
    ++rounds_;
  }

  double x_ = 0;
  int rounds_ = 0;
  int moves_ = 0;
  int named_ = 0;
  double recognised_ = 0;
};

CASTOR_COMPONENT(ColourChanger, "for tests: gives regions other colours")

TEST_F(ObjectTrackerSystem, LosesNothingOfWhatTheRecogniserWritesAtTheSameTime) {
  auto text =
    with(vision_cast(), tracker_line,
         std::string{tracker_line} + " --update-period 5ms --period 5ms --least-move 0.5\n"
                                     "CPP UM changer ColourChanger --restart temporary");
  cast::ParseOptions parse_options;
  parse_options.variables = {{"tracker", "yes"},
                             {"source", scene("red cube at -0.25 0 size 0.07\n"
                                              "after 2s move red cube to 0.25 0 over 6s\n")}};
  auto parsed = cast::parse_string(text, CASTOR_CONFIGS "/vision.cast", parse_options);
  ASSERT_TRUE(parsed.ok()) << render(parsed.diagnostics);
  System system{parsed.architecture.value()};
  ASSERT_TRUE(system.start());
  auto reason = system.wait({30s, {}});
  system.stop();
  for (auto& x : system.summary().components)
    EXPECT_EQ(x.failure, "") << x.identity.name;
  EXPECT_EQ(reason, EndReason::ended_by_component) << "not enough happened";
}

/// Moves an object as a tracker does, but as fast as it can, and gives its region another colour
/// each time. Fails if the recogniser, which writes as often, undoes any of it.
class HastyTracker final : public UnmanagedComponent {
  void start() override {
    ROI roi;
    SceneObject object;
    roi.box = {{100, 100}, 10, 10};
    roi.has_features = true;
    roi.features.extent.size = {0.1, 0.1, 0.1};
    object.box = roi.features.extent;
    object_ = add(object);
    roi.object_id = object_.id;
    roi_ = add(roi);
  }

  void run() override {
    auto camera = nominal_camera(640, 480);
    while (rounds_ < 5000 || named_ < 500) {
      if (!is_running())
        return;
      auto before = read<SceneObject>(object_);
      if (rounds_ > 0 && before->pose.position != place_)
        throw std::runtime_error(fmt::format("round {}: the object was put back", rounds_));
      if (before->colour.confidence < named_as_)
        throw std::runtime_error(fmt::format("round {}: a colour was lost", rounds_));
      named_ += before->colour.confidence > named_as_;
      named_as_ = before->colour.confidence;
      auto object = *before;
      auto roi = *read<ROI>(roi_);
      auto box = roi.box;
      box.center.x += rounds_ % 200 < 100 ? 1 : -1;
      move_to(box, camera, roi, object);
      roi.features.colours = {{"many", static_cast<double>(rounds_ + 1)}};
      auto place = object.pose.position;
      WriteBatch batch;
      batch.overwrite(roi_, std::move(roi));
      batch.add(here(new_id()), changes(object_.id, *before, object));
      batch.overwrite(object_, std::move(object));
      try {
        write(batch);
        place_ = place;
        ++rounds_;
      } catch (const ConsistencyException&) {
        debug("once more");
      }
    }
    end_system(0, "done");
  }

  Address object_;
  Address roi_;
  Point3 place_;
  int rounds_ = 0;
  int named_ = 0;
  double named_as_ = 0;
};

CASTOR_COMPONENT(HastyTracker, "for tests: moves an object as fast as it can")

TEST(Recogniser, PutsNothingBackWhereItWas) {
  auto parsed = cast::parse_string("HOST localhost\nSUBARCHITECTURE vision\n"
                                   "CPP WM SubarchitectureWorkingMemory\n"
                                   "CPP TM AlwaysPositiveTaskManager\n"
                                   "CPP MG recogniser Recogniser\n"
                                   "CPP UM tracker HastyTracker --restart temporary\n",
                                   "test.cast");
  ASSERT_TRUE(parsed.ok()) << render(parsed.diagnostics);
  System system{parsed.architecture.value()};
  ASSERT_TRUE(system.start());
  auto reason = system.wait({30s, {}});
  system.stop();
  for (auto& x : system.summary().components)
    EXPECT_EQ(x.failure, "") << x.identity.name;
  EXPECT_EQ(reason, EndReason::ended_by_component);
}

} // namespace

} // namespace castor::vision
