// Vision while somebody inhibits it: because an arm is in the picture, for instance.
#include "castor/tests/perception/vision/vision_system.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::vision {

namespace {

/// Inhibits vision once it has processed the scene (or from the beginning), for some time, or until
/// it fails.
class Arm final : public UnmanagedComponent {
  void start() override {
    if (from_beginning_)
      inhibit();
    on_change(overwritten<SceneChanged>().in("vision"), [this](const ChangeEvent& event) {
      has_processed_ = has_processed_ || read<SceneChanged>(event.address)->processed;
    });
  }

  void run() override {
    while (!from_beginning_ && !has_processed_)
      if (!wait_for_changes())
        return;
    if (!from_beginning_)
      inhibit();
    sleep_for(time_.get());
    if (fails_)
      throw std::runtime_error("the arm is stuck");
    delete_entry(inhibition_);
    sleep_for(1h);
  }

  void inhibit() {
    inhibition_ = {"vision", "arm"};
    add(inhibition_, InhibitSceneProcessing{component_name()}, {.ephemeral = true});
  }

  Option<bool> from_beginning_{this, "from-beginning", false, "inhibits from the beginning"};
  Option<bool> fails_{this, "fails", false, "fails in the end"};
  Option<std::chrono::milliseconds> time_{this, "time", 2500ms, "how long it is in the picture"};
  bool has_processed_ = false;
  Address inhibition_;
};

CASTOR_COMPONENT(Arm, "for tests: inhibits vision for some time")

class InhibitedVision : public VisionSystem {
protected:
  static std::string with_arm(const std::string& options) {
    return vision_cast() +
           "\nSUBARCHITECTURE manipulation\n"
           "CPP WM SubarchitectureWorkingMemory\n"
           "CPP TM AlwaysPositiveTaskManager\n"
           "CPP UM arm Arm --restart temporary " +
           options +
           "\n"
           "ACCESS manipulation WRITES vision\n";
  }

  /// What was written to vision's working memory while it was inhibited.
  SystemOptions noting() {
    SystemOptions result;
    result.on_change = [this](const ChangeEvent& event) {
      if (event.address.subarchitecture != "vision")
        return;
      if (event.type_name() == type_name<InhibitSceneProcessing>())
        is_inhibited_ = event.operation == Operation::add;
      else if (is_inhibited_)
        while_inhibited_.insert(event.type_name() + " by " + event.source);
      if (is_inhibited_ && event.has_changed(&SceneObject::pose))
        moved_while_inhibited_by_.insert(event.source);
      if (event.type_name() == type_name<SceneObject>() && event.operation != Operation::overwrite)
        (is_inhibited_ ? told_while_inhibited_ : told_otherwise_) += 1;
    };
    return result;
  }

  bool is_inhibited_ = false;
  std::set<std::string> while_inhibited_;
  std::set<std::string> moved_while_inhibited_by_;
  int told_while_inhibited_ = 0;
  int told_otherwise_ = 0;
};

std::vector<std::string> labels(const std::vector<SceneObject>& objects) {
  std::vector<std::string> result;
  for (auto& x : objects)
    result.push_back(x.label.value);
  std::ranges::sort(result);
  return result;
}

TEST_F(InhibitedVision, DoesNotSeeWhatHappensMeanwhileAndLooksAfterwards) {
  auto system = watch(with_arm(""),
                      {{"source", scene("red cube at -0.15 0 size 0.07\n"
                                        "after 2s add yellow disc at 0.12 0 size 0.09\n")}},
                      noting(), 4s);
  // The words of objects that were seen before may come late.
  while_inhibited_.erase("ROI by feature-extractor");
  while_inhibited_.erase("SceneObject by recogniser");
  while_inhibited_.erase("SceneObjectUpdate by recogniser");
  while_inhibited_.erase("ScenePicture by pictures");
  EXPECT_EQ(while_inhibited_, (std::set<std::string>{}));
  EXPECT_EQ(told_while_inhibited_, 0);
  EXPECT_EQ(labels(all<SceneObject>(*system)),
            (std::vector<std::string>{"red cube", "yellow circle"}));
}

TEST_F(InhibitedVision, DoesNothingAfterwardsIfNothingHasChanged) {
  auto system = watch(with_arm("--time 500ms"),
                      {{"source", scene("red cube at -0.15 0 size 0.07\n")}}, noting(), 2s);
  EXPECT_EQ(told_otherwise_, 1);
  auto scenes = all<SceneChanged>(*system);
  ASSERT_EQ(scenes.size(), 1u);
  EXPECT_TRUE(scenes[0].processed);
}

TEST_F(InhibitedVision, BeginsWhenTheInhibitionEnds) {
  auto system = watch(with_arm("--from-beginning true --time 1s"),
                      {{"source", scene("red cube at -0.15 0 size 0.07\n")}}, noting(), 2s);
  EXPECT_EQ(told_while_inhibited_, 0);
  EXPECT_EQ(labels(all<SceneObject>(*system)), (std::vector<std::string>{"red cube"}));
}

TEST_F(InhibitedVision, GoesOnWhenTheInhibitorHasFailed) {
  cast::ParseOptions options;
  options.variables = {{"source", scene("red cube at -0.15 0 size 0.07\n")}};
  auto parsed = cast::parse_string(with_arm("--from-beginning true --time 500ms --fails true"),
                                   CASTOR_CONFIGS "/vision.cast", options);
  ASSERT_TRUE(parsed.ok()) << render(parsed.diagnostics);
  System system{parsed.architecture.value(), noting()};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(test::eventually([&] { return has_processed_a_change(system); }));
  EXPECT_EQ(system.wait({60s, 1s}), EndReason::quiet);
  system.stop();
  EXPECT_EQ(told_while_inhibited_, 0);
  EXPECT_EQ(labels(all<SceneObject>(system)), (std::vector<std::string>{"red cube"}));
}

TEST_F(InhibitedVision, DoesNotTrackMeanwhile) {
  auto text = with_arm("");
  auto system = watch(text,
                      {{"tracker", "yes"},
                       {"source", scene("red cube at -0.15 0.05 size 0.07\n"
                                        "after 2s move red cube to 0.2 0.05 over 400ms\n")}},
                      noting(), 4s);
  EXPECT_FALSE(moved_while_inhibited_by_.contains("tracker"));
  EXPECT_FALSE(moved_while_inhibited_by_.contains("segmentor"));
  auto objects = all<SceneObject>(*system);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_NEAR(objects[0].pose.position.x, 0.2, 0.03);
}

} // namespace

} // namespace castor::vision
