// From what is said to packed logical forms, dialogue moves and clarification requests, on working
// memory.
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string hearing(const std::string& text) {
  return "HOST localhost\n"
         "SUBARCHITECTURE communication\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM utterances UtteranceSource --text \"" +
         text +
         "\"\n"
         "CPP UM parser UtteranceParser\n"
         "CPP UM interpreter DialogueInterpreter\n"
         "CPP UM monitor CommunicationBindingMonitor\n"
         "CPP UM planner ContentPlanner\n"
         "CPP UM realiser SentenceRealiser\n"
         "CPP UM speech SpeechOutput\n"
         "SUPERVISE communication RESTARTS 1000 IN 10s\n";
}

template <class T>
std::vector<T> all(TestSystem& system) {
  std::vector<T> result;
  for (auto& entry : system.system().entries("communication"))
    if (auto x = entry->value.as<T>())
      result.push_back(*x);
  return result;
}

/// Whoever acts on requests: tells of each that it is over.
class RequestEnder final : public UnmanagedComponent {
  void start() override {
    on_change(added<DialogueMove>().in("communication"), [this](const ChangeEvent& event) {
      add(planning::RequestEnded{EntryPointer<DialogueMove>{event.address}, is_done_.get()});
    });
  }

  Option<bool> is_done_{this, "done", false, "whether requests are done"};
};

CASTOR_COMPONENT(RequestEnder, "tells that requests are over")

/// Somebody asks for something, which is done or cannot be done.
std::string asking(const std::string& text, bool is_done) {
  return "HOST localhost\n"
         "SUBARCHITECTURE communication\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM utterances UtteranceSource --text \"" +
         text +
         "\"\n"
         "CPP UM parser UtteranceParser --lexicon \"english.ccg actions.ccg tabletop.words "
         "table-actions.words\" --base \"" CASTOR_LANGUAGE_FOLDER "\"\n"
         "CPP UM interpreter DialogueInterpreter\n"
         "CPP UM planner ContentPlanner --motivation motivation\n"
         "SUBARCHITECTURE motivation\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM ender RequestEnder" +
         std::string{is_done ? " --done" : ""} + "\n";
}

TEST(CommunicationSystem, SaysTheAlternativeOfARequestThatCannotBeDone) {
  const std::string alternative =
    "Put the ball behind the box, or in front of it if there is no room.";
  const std::string question = "Put the ball behind the box, and then tell me where it is.";
  TestSystem refused{asking(alternative, false)};
  refused.expect_entry(
    "PhonString in communication where word_sequence == \"put the ball in front of it\"");
  TestSystem asked{asking(question, true)};
  asked.expect_entry("PhonString in communication where word_sequence == \"tell me where it is\"");
}

TEST(CommunicationSystem, FormsGrowWordByWord) {
  TestSystem system{hearing("This is a blue square.")};
  auto entry = system.expect_entry("PackedLogicalForm in communication where state == \"pruned\"");
  // Added with the first of five words, overwritten with the others, at the end, and when there was
  // nobody to say which readings are supported.
  EXPECT_EQ(entry->version, 6u);
  auto form = entry->value.as<PackedLogicalForm>();
  EXPECT_EQ(form->string_position, 5);
  EXPECT_TRUE(form->unparsable.empty());
  system.expect_entry("DialogueMove in communication where type == \"assertion\"");
}

TEST(CommunicationSystem, TellsWhatIsDoneBySayingSomething) {
  const std::map<std::string, std::string> moves{{"Put the cup near the box.", "action_directive"},
                                                 {"What colour is the square?", "question_w"},
                                                 {"Is the ball red?", "question_yn"},
                                                 {"Hello.", "opening"},
                                                 {"Good bye.", "closing"},
                                                 {"Yes.", "accept"},
                                                 {"No.", "reject"}};
  for (auto& [text, type] : moves) {
    SCOPED_TRACE(text);
    TestSystem system{hearing(text)};
    system.expect_entry("DialogueMove in communication where type == \"" + type + '"');
  }
}

TEST(CommunicationSystem, PointsWhereItIsToldToInEachRun) {
  const castor::test::TemporaryFolder folder;
  auto pointing_at = [&](const std::string& place) {
    return "HOST localhost\n"
           "SUBARCHITECTURE communication\n"
           "CPP WM SubarchitectureWorkingMemory --journal full --journal-dir \"" +
           folder.path().string() +
           "\"\n"
           "CPP TM AlwaysPositiveTaskManager\n"
           "CPP UM hand PointingSource --at \"" +
           place +
           "\"\n"
           "SUPERVISE communication RESTARTS 1000 IN 10s\n";
  };
  for (const auto* x : {"0.1", "0.2", "0.2"}) {
    TestSystem system{pointing_at(std::string{x} + ",0.3")};
    const auto entry =
      system.expect_entry(std::string{"Pointing in communication where x == "} + x);
    EXPECT_EQ(entry->address.id, "pointing");
    EXPECT_EQ(all<Pointing>(system).size(), 1u);
    if (std::string{x} == "0.1") {
      system.inject("crash hand");
      system.expect_back("hand");
      system.wait_until("it is pointed there again",
                        [&] { return all<Pointing>(system).size() == 1; });
    }
  }
  TestSystem nowhere{pointing_at("")};
  nowhere.wait_until("nothing is pointed at", [&] { return all<Pointing>(nowhere).empty(); });
}

TEST(CommunicationSystem, HearsAndSpeaksByOtherPrograms) {
  castor::test::TemporaryFolder folder;
  const auto file = (folder.path() / "spoken").string();
  auto text = hearing("");
  auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("--text \"\"", "--program \"echo Hello. Put the zorg there.\"");
  replace("SpeechOutput", "SpeechOutput --voice \"printf %s>>" + file + "\"");
  TestSystem system{text};
  system.expect_entry("DialogueMove in communication where type == \"opening\"");
  system.wait_until("the robot has asked back aloud", [&] {
    std::ifstream in{file};
    const std::string spoken{std::istreambuf_iterator<char>{in}, {}};
    return spoken.find("zorg") != spoken.npos;
  });
  system.expect_nobody_else_down();
}

TEST(CommunicationSystem, AsksBackAboutWhatIsNotUnderstood) {
  TestSystem system{hearing("Put the zorg near the box.")};
  auto said =
    system.expect_entry("SpokenOutputItem in communication")->value.as<SpokenOutputItem>();
  EXPECT_THAT(said->text, AllOf(HasSubstr("I do not understand that"), HasSubstr("zorg")));
  system.expect_entry("DialogueMove in communication where type == \"none\"");
}

TEST(CommunicationSystem, PointsWhereItIsToldOnce) {
  auto text = hearing("What is this?");
  const std::string parser = "CPP UM parser";
  text.insert(text.find(parser), "CPP UM pointing PointingSource --at \"-0.1,0.25\"\n");
  TestSystem system{text};
  auto pointing = system.expect_entry("Pointing in communication where held == true");
  EXPECT_EQ(pointing->value.as<Pointing>()->x, -0.1);
  EXPECT_EQ(pointing->value.as<Pointing>()->y, 0.25);
  // There is no binding, so nothing is there.
  system.expect_entry(
    "SpokenOutputItem in communication where text == \"I do not see what you point at.\"");
  auto referents = system.expect_entry("MoveReferents in communication");
  auto use = referents->value.as<MoveReferents>()->pointing;
  ASSERT_TRUE(use);
  EXPECT_TRUE(use->taken_up);
  EXPECT_EQ(use->pointing.address, pointing->address);
  for (std::uint64_t life = 2; life < 4; ++life) {
    system.inject("crash pointing");
    system.expect_back("pointing", life);
  }
  EXPECT_EQ(all<Pointing>(system).size(), 1u);
}

TEST(CommunicationSystem, RefusesToPointAtWhatIsNoPlace) {
  auto text = hearing("Hello.");
  const std::string parser = "CPP UM parser";
  text.insert(text.find(parser), "CPP UM pointing PointingSource --at there\n");
  try {
    TestSystem system{text};
    FAIL() << "the system has started";
  } catch (const std::exception& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("there"), HasSubstr("X,Y in metres")));
  }
}

TEST(CommunicationSystem, UnderstandsEverythingOnceWhoeverFails) {
  std::string text;
  for (int i = 0; i < 40; ++i)
    text += "Put the ball near the box on the table. ";
  TestSystem system{hearing(text)};
  for (std::uint64_t life = 2; life < 5; ++life)
    for (auto* name : {"parser", "interpreter", "utterances"}) {
      system.inject(std::string{"crash "} + name);
      system.expect_back(name, life);
    }
  auto heard = all<PhonString>(system).size();
  EXPECT_GE(heard, 1u);
  system.wait_until("every utterance is understood",
                    [&] { return all<DialogueMove>(system).size() == heard; });
  for (auto& form : all<PackedLogicalForm>(system)) {
    EXPECT_EQ(form.state, InterpretationState::pruned);
    EXPECT_EQ(form.string_position, 9);
  }
  EXPECT_EQ(all<PackedLogicalForm>(system).size(), 40u);
  EXPECT_EQ(all<PhonString>(system).size(), 40u);
}

TEST(CommunicationSystem, AnswersEverythingOnceWhoeverFails) {
  std::string text;
  for (int i = 0; i < 20; ++i)
    text += "Hello. ";
  // The first callbacks are those that fail, whatever they are about.
  TestSystem system{hearing(text + "\" --delay \"300ms")};
  for (auto* name : {"planner", "speech"})
    system.inject(std::string{"throw in callback 1 of "} + name);
  for (auto* name : {"planner", "speech"})
    system.expect_back(name, 2);
  system.wait_until("every utterance is answered",
                    [&] { return all<SpokenOutputItem>(system).size() == 20; });
  EXPECT_EQ(all<ContentPlanningGoal>(system).size(), 20u);
}

} // namespace

} // namespace castor::communication::test
