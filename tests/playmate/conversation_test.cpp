// What the PlayMate says about the rendered table, and what it learns from being told.
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/binding/types.hpp"
#include "castor/communication/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/tests/playmate/playmate.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <sys/stat.h>

namespace castor::test {

namespace {

using communication::SpokenOutputItem;
using testing::ElementsAre;
using testing::HasSubstr;

/// In the order in which they were said.
std::vector<std::string> sayings(TestSystem& system) {
  std::vector<std::string> result;
  for (auto& entry : system.system().entries("communication"))
    if (auto x = entry->value.as<SpokenOutputItem>())
      result.insert(result.begin(), x->text);
  return result;
}

TEST(Conversation, IsAboutWhatIsThere) {
  TestSystem system{playmate_cast(),
                    playmate_options({{"say", "Hello. What colour is the square? Where is it? "
                                              "How many red things are there? "
                                              "Is the red thing left of the ball? The triangle. "
                                              "What is behind the triangle? "
                                              "Is the triangle the same colour as the ball? "
                                              "Put the cup near the box. Good bye."}})};
  system.wait_until("the robot has said good bye", [&] {
    auto all = sayings(system);
    return std::ranges::find(all, "Bye.") != all.end();
  });
  EXPECT_THAT(sayings(system),
              ElementsAre("Hello.", "It is blue.", "It is to the left of the triangle.",
                          "There are two red things.", "Which red thing do you mean?", "No.",
                          "There is a green cube and a small red ball.", "Yes.",
                          "I do not see a cup.", "Bye."));
  auto dialogue = system.expect_entry("DialogueStructure in communication")
                    ->value.as<communication::DialogueStructure>();
  auto clarification =
    std::ranges::find(dialogue->turns, communication::RhetoricalRelation::clarification,
                      &communication::DialogueTurn::relation);
  ASSERT_NE(clarification, dialogue->turns.end());
  EXPECT_EQ(clarification->speaker, "human");
  system.expect_nobody_else_down();
}

std::string answer_to_what_is_this(const std::string& point) {
  TestSystem system{playmate_cast(),
                    playmate_options({{"say", "What is this?"}, {"point", point}})};
  auto reply = system.expect_entry("SpokenOutputItem in communication");
  system.expect_nobody_else_down();
  return reply->value.as<SpokenOutputItem>()->text;
}

TEST(Conversation, IsAboutWhatIsPointedAt) {
  EXPECT_THAT(answer_to_what_is_this("0.05,0.07"), HasSubstr("red ball"));
  EXPECT_THAT(answer_to_what_is_this("-0.16,0.12"), HasSubstr("green cube"));
  EXPECT_EQ(answer_to_what_is_this("0.6,0.6"), "I do not see what you point at.");
  EXPECT_EQ(answer_to_what_is_this(""), "Which thing do you mean?");
}

TEST(Conversation, LearnsWhatIsClarified) {
  TestSystem system{
    playmate_cast(),
    playmate_options({{"say", "This is a toy. The ball. What colour is the toy? The red thing is a "
                              "plate. The triangle. What shape is the plate? The red thing is "
                              "green. The ball. Good bye."}})};
  system.wait_until("the robot has said good bye", [&] {
    auto all = sayings(system);
    return std::ranges::find(all, "Bye.") != all.end();
  });
  EXPECT_THAT(sayings(system),
              ElementsAre("Which thing do you mean?", "Ok.", "It is red.",
                          "Which red thing do you mean?", "Ok.", "It is a triangle.",
                          "Which red thing do you mean?", "No, it is red.", "Bye."));
  system.expect_nobody_else_down();
}

TEST(Conversation, IsNotCertainOfSizesWithoutACalibration) {
  TestSystem system{playmate_cast(),
                    playmate_options({{"source", CASTOR_CONFIGS "/scenes/table.jpg"},
                                      {"say", "How large is the red cube? Good bye."}})};
  system.wait_until("the robot has said good bye", [&] {
    auto all = sayings(system);
    return std::ranges::find(all, "Bye.") != all.end();
  });
  EXPECT_THAT(sayings(system).front(), HasSubstr("I think it is"));
  system.expect_nobody_else_down();
}

/// Points elsewhere as soon as the robot has said something.
class MovingHand final : public UnmanagedComponent {
  void start() override {
    on_change(added<SpokenOutputItem>(), [this](const ChangeEvent&) {
      for (auto& x : read_all<communication::Pointing>(1))
        overwrite(x.address, communication::Pointing{-0.16, 0.14, now().count(), false});
    });
  }
};

CASTOR_COMPONENT(MovingHand, "points elsewhere when the robot has said something")

TEST(Conversation, FollowsTheHand) {
  TemporaryFolder folder;
  const auto questions = (folder / "questions").string();
  ASSERT_EQ(mkfifo(questions.c_str(), 0600), 0);
  auto text = playmate_cast();
  const std::string parser = "CPP UM parser";
  text.insert(text.find(parser), "CPP UM hand MovingHand\n");
  auto options = playmate_options({{"point", "0.05,0.07"}, {"hear", "cat " + questions}});
  // The sentences come from outside, while the test does not wait for the system.
  options.simulated_time = false;
  TestSystem system{text, options};
  std::ofstream ask{questions};
  ask << "What colour is this?" << std::endl;
  system.expect_entry("SpokenOutputItem in communication where text == \"It is red.\"");
  system.expect_entry("Pointing in communication where held == false");
  ask << "And this?" << std::endl;
  system.expect_entry("SpokenOutputItem in communication where text == \"It is green.\"");
  ask << "This is a ball." << std::endl;
  system.wait_until("the robot has said that it is none", [&] {
    auto all = sayings(system);
    return all.size() == 3 && all.back().starts_with("No, it is");
  });
  system.expect_nobody_else_down();
}

TEST(Conversation, TeachesWordsForWhatIsPointedAt) {
  TestSystem system{playmate_cast(),
                    playmate_options({{"recogniser", "no"},
                                      {"point", "0.05,0.07"},
                                      {"say", "This is a red ball. What is the red ball? "
                                              "What is this? This is a blue cube."}})};
  system.wait_until("all is answered", [&] { return sayings(system).size() == 4; });
  EXPECT_THAT(sayings(system), ElementsAre("Ok.", "It is a red ball.", "It is a red ball.",
                                           "No, it is a red ball."));
  system.expect_entry("LearnedWords in vision");
  // The words are bound to what is there.
  const std::string prefix = "vision/object/";
  std::vector<double> taught;
  for (auto& entry : system.system().entries("binding"))
    if (auto bound = entry->value.as<binding::BindingUnion>();
        bound && std::ranges::find(bound->sources, "communication") != bound->sources.end())
      for (auto& proxy : bound->proxy_ids)
        for (auto& object : system.system().entries("vision"))
          if (proxy == prefix + object->address.id)
            taught.push_back(object->value.as<vision::SceneObject>()->box.centroid.x);
  EXPECT_THAT(taught, ElementsAre(testing::DoubleNear(0.05, 0.02)));
  system.expect_nobody_else_down();
}

TEST(Conversation, HasTheViewOfTheCamera) {
  TemporaryFolder folder;
  const auto scene = (folder / "turned.scene").string();
  for (auto& [camera, leftmost] : std::vector<std::pair<std::string, std::string>>{
         {"0 -0.62 0.55", "red"}, {"0.62 0 0.55", "blue"}, {"0 0.62 0.55", "green"}}) {
    std::ofstream{scene} << "table wood\ncamera " << camera
                         << " looking-at 0 0 0 fov 42\nlight -1 -1 2\nnoise 2\nseed 1\n"
                            "red cube at -0.15 0 size 0.07\n"
                            "green cube at 0.15 0.02 size 0.07\n"
                            "blue cube at 0.02 -0.15 size 0.07\n";
    TestSystem system{playmate_cast(),
                      playmate_options({{"source", "scene:" + scene},
                                        {"relations", "directions"},
                                        {"say", "What colour is the leftmost cube? Is the " +
                                                  leftmost + " cube left of all other cubes?"}})};
    system.wait_until("both questions are answered", [&] { return sayings(system).size() == 2; });
    EXPECT_THAT(sayings(system), ElementsAre("It is " + leftmost + ".", "Yes.")) << camera;
    system.expect_nobody_else_down();
  }
}

TEST(Conversation, DropsReadingsThatTheSceneDoesNotSupport) {
  // The ball is not near the box; so the box is what is on the table.
  TestSystem system{playmate_cast(),
                    playmate_options({{"say", "Put the ball near the box on the table."}})};
  auto form = system.expect_entry("PackedLogicalForm in communication where state == \"pruned\"")
                ->value.as<communication::PackedLogicalForm>();
  EXPECT_EQ(form->readings.size(), 1u);
  auto context =
    system.expect_entry("ContextInfo in communication")->value.as<communication::ContextInfo>();
  EXPECT_TRUE(std::ranges::any_of(context->supports, [](auto& x) { return !x.supported; }));
}

TEST(Conversation, KnowsWhereThingsHaveGone) {
  TemporaryFolder folder;
  const auto scene = (folder / "moving.scene").string();
  std::ofstream{scene} << "table wood\ncamera 0 -0.62 0.55 looking-at 0 0.03 0 fov 42\n"
                          "light -1 -1 2\nnoise 2\nseed 1\n"
                          "green cube at 0 0 size 0.07\n"
                          "red sphere at -0.15 0 size 0.07\n"
                          "after 1500ms move red sphere to 0 -0.15 over 300ms\n"
                          "after 1800ms move red sphere to 0.15 0 over 200ms\n";
  // Questions are asked when it is time.
  const auto questions = (folder / "questions").string();
  ASSERT_EQ(mkfifo(questions.c_str(), 0600), 0);
  TestSystem system{playmate_cast(), playmate_options({{"source", "scene:" + scene},
                                                       {"hear", "cat " + questions},
                                                       {"settled", "0s"}})};
  std::ofstream ask{questions};
  system.wait_until("the ball is where it was moved to", [&] {
    auto entries = system.system().entries("vision");
    return std::ranges::any_of(entries, [](auto& entry) {
      auto object = entry->value.template as<vision::SceneObject>();
      return object && object->colour.value == "red" && object->box.centroid.x > 0.12;
    });
  });
  std::size_t asked = 0;
  system.wait_until("the robot knows that the ball is right of the cube", [&] {
    auto all = sayings(system);
    if (!all.empty() && all.back() == "Yes.")
      return true;
    if (all.size() == asked) {
      ask << "Is the ball right of the cube?" << std::endl;
      ++asked;
    }
    return false;
  });
  ask << "Is the ball left of the cube?" << std::endl;
  system.wait_until("the last question is answered",
                    [&] { return sayings(system).size() == asked + 1; });
  EXPECT_EQ(sayings(system).back(), "No.");
  system.expect_nobody_else_down();
}

/// A table that gets one blue square, and later another.
std::string squares(const TemporaryFolder& folder) {
  auto file = (folder / "squares.scene").string();
  std::ofstream{file} << "table wood\ncamera 0 -0.62 0.55 looking-at 0 0.03 0 fov 42\n"
                         "light -1 -1 2\nnoise 2\nseed 1\n"
                         "after 500ms add blue square at 0.05 0.0 size 0.09 turned 15\n"
                         "after 3s add blue square at -0.15 0.1 size 0.09 turned 40\n";
  return "scene:" + file;
}

TEST(Conversation, TeachesWordsThatAreUsedLater) {
  TemporaryFolder folder;
  auto text = playmate_cast();
  const std::string monitor = "vision-monitor VisionBindingMonitor";
  // Vision keeps to itself what it would call things.
  text.insert(text.find(monitor) + monitor.size(), " --certain 2");
  const auto words = (folder / "words").string();
  TestSystem system{
    text, playmate_options(
            {{"source", squares(folder)}, {"words", words}, {"say", "This is a cyan square."}})};
  system.expect_entry("LearnedWords in vision");
  system.wait_until(
    "two things are called cyan",
    [&] {
      auto entries = system.system().entries("vision");
      return std::ranges::count_if(entries,
                                   [](auto& entry) {
                                     auto object = entry->value.template as<vision::SceneObject>();
                                     return object && object->colour.value == "cyan";
                                   }) >= 1 &&
             std::ranges::count_if(
               entries, [](auto& entry) { return entry->type_name() == "SceneObject"; }) == 2;
    },
    std::chrono::seconds{20});
  std::ifstream in{words};
  EXPECT_TRUE(in) << "what was learned is not kept";
}

} // namespace

} // namespace castor::test
