// What the PlayMate says about the rendered table, and what it learns from being told.
#include "castor/communication/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/tests/playmate/playmate.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <sys/stat.h>

namespace castor::test {

namespace {

using communication::SpokenOutputItem;
using testing::ElementsAre;

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
                          "There is a small green cube and a small red ball.", "Yes.",
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
