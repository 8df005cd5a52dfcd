// The vision subarchitecture with a learner in it.

#include "castor/tests/perception/vision/vision_system.hpp"

#include "castor/actors/component/registry.hpp"

#include <optional>
#include <set>

namespace castor::vision {

namespace {

/// Says what the leftmost object is called as soon as the recogniser has named it, once.
class Tutor final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<SceneObject>(), [this](const ChangeEvent& event) {
      auto object = read<SceneObject>(event.address);
      if (has_taught_ || object->colour.value == "unknown" || object->pose.position.x > -0.1)
        return;
      has_taught_ = true;
      LearnInstruction instruction;
      instruction.target_id = event.address.id;
      instruction.attributes = {{"colour", {"azure", 1}}, {"shape", {"gizmo", 1}}};
      add(instruction);
    });
  }

  bool has_taught_ = false;
};

CASTOR_COMPONENT(Tutor, "for tests: teaches two words")

class VisualLearnerSystem : public VisionSystem {
protected:
  /// What the things on the table are called.
  std::multiset<std::string> names(const std::string& things, bool with_tutor,
                                   std::chrono::milliseconds quiet = 1500ms) {
    SystemOptions options;
    options.on_change = [this](const ChangeEvent& event) {
      updates += event.type_name() == "SceneObjectUpdate";
      writes += event.type_name() == "SceneObject" && event.operation != Operation::remove;
    };
    auto text = vision_cast();
    if (with_tutor)
      text += "\nCPP UM tutor Tutor\n";
    auto system = watch(
      text, {{"learner", "yes"}, {"words", (folder / "words").string()}, {"source", scene(things)}},
      options, quiet);
    instructions = all<LearnInstruction>(*system).size();
    std::multiset<std::string> result;
    for (auto& x : all<SceneObject>(*system))
      result.insert(x.label.value);
    return result;
  }

  int updates = 0;
  int writes = 0;
  std::size_t instructions = 0;
};

TEST_F(VisualLearnerSystem, NamesWhatIsLikeWhatItWasTaught) {
  const std::string taught = "#0080ff sphere at -0.15 0 size 0.07\n";
  const std::string others = "after 2s add #0080ff sphere at 0.1 0.1 size 0.06 name=b\n"
                             "after 2s add #0080ff disc at 0 -0.12 size 0.09\n"
                             "after 2s add red cube at 0.18 -0.05 size 0.07\n";
  EXPECT_EQ(names(taught + others, true, 2500ms),
            (std::multiset<std::string>{"azure gizmo", "azure gizmo", "azure circle", "red cube"}));
  EXPECT_EQ(instructions, 0u) << "they were seen to";
  EXPECT_EQ(updates, writes) << "each write of an object says what it changed";
  // Another run has the file, and nobody who teaches.
  EXPECT_EQ(names("#0080ff sphere at 0.1 0 size 0.07\nred cube at -0.1 0 size 0.07\n", false),
            (std::multiset<std::string>{"azure gizmo", "red cube"}));
}

TEST_F(VisualLearnerSystem, ChangesNothingUntilItIsTaught) {
  EXPECT_EQ(names("blue sphere at 0.1 0 size 0.07\nred cube at -0.1 0 size 0.07\n", false),
            (std::multiset<std::string>{"blue sphere", "red cube"}));
  EXPECT_FALSE(std::filesystem::exists(folder / "words"));
}

TEST_F(VisualLearnerSystem, ABrokenFileIsAClearFailureOfTheLearner) {
  std::ofstream{folder / "words"} << "# words\ncolour azure examples some\n";
  cast::ParseOptions parse_options;
  parse_options.variables = {{"learner", "yes"},
                             {"words", (folder / "words").string()},
                             {"source", scene("red cube at 0 0 size 0.07\n")}};
  auto parsed = cast::parse_string(with(vision_cast(), "CPP MG learner",
                                        "CPP MG learner VisualLearner --words \"%(words)\" "
                                        "--restart temporary"),
                                   CASTOR_CONFIGS "/vision.cast", parse_options);
  ASSERT_TRUE(parsed.ok()) << render(parsed.diagnostics);
  System system{parsed.architecture.value()};
  try {
    system.start();
    FAIL() << "it has started";
  } catch (const SystemError& e) {
    std::string message = e.what();
    EXPECT_NE(message.find("learner cannot be configured"), message.npos) << message;
    EXPECT_NE(message.find("words:2: error: "), message.npos) << message;
    EXPECT_NE(message.find("; colour azure examples some; "), message.npos) << message;
  }
}

} // namespace

} // namespace castor::vision
