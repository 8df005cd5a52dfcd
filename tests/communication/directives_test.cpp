// What people ask a robot with an arm to do, and what it understands that it is to do.
#include "castor/tests/communication/directive_sentences.hpp"
#include "castor/tests/communication/sentence_set.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication::test {

namespace {

/// A red ball, a blue one behind to its right, a red box in the middle, a green one at the right, a
/// yellow cylinder behind the red ball, and a green disc in front.
const std::vector<ThingInSet> table{
  {"a", "sphere", "red", -0.20, 0.00, 0.06},      {"b", "sphere", "blue", 0.10, 0.12, 0.06},
  {"c", "cube", "red", 0.00, -0.10, 0.08},        {"d", "cube", "green", 0.22, 0.00, 0.07},
  {"e", "cylinder", "yellow", -0.10, 0.15, 0.05}, {"f", "circle", "green", -0.05, -0.25, 0.07}};

std::string joined(const std::vector<std::string>& words) {
  std::string result;
  for (const auto& x : words)
    result += (result.empty() ? "" : ",") + x;
  return result;
}

/// As in the files: "put 1 of a,b left c".
std::string shown(const DirectiveStep& x, bool asks_whether_possible) {
  static const std::map<std::string, std::string> names{{"Put", "put"},
                                                        {"Take", "take"},
                                                        {"PutDown", "down"},
                                                        {"Give", "give"},
                                                        {"Push", "push"},
                                                        {"PutBack", "back"},
                                                        {"Swap", "swap"},
                                                        {"Sort", "sort"},
                                                        {"Clear", "clear"},
                                                        {"Stop", "stop"},
                                                        {"Wait", "wait"},
                                                        {"GoOn", "go-on"},
                                                        {"Undo", "undo"},
                                                        {"Restore", "restore"},
                                                        {"WhereWas", "where-was"},
                                                        {"Forbid", "forbid"},
                                                        {"Allow", "allow"},
                                                        {"WhichMoved", "which-moved"},
                                                        {"LastMoved", "last-moved"},
                                                        {"NotMoved", "not-moved"},
                                                        {"MovedForThat", "moved-for-that"},
                                                        {"Displaced", "displaced"},
                                                        {"Touching", "touching"},
                                                        {"ListFromLeft", "list-from-left"},
                                                        {"ListFromRight", "list-from-right"},
                                                        {"ListFromFront", "list-from-front"},
                                                        {"ListFromBack", "list-from-back"},
                                                        {"ListFromSmallest", "list-from-smallest"},
                                                        {"ListFromLargest", "list-from-largest"},
                                                        {"ListFromLowest", "list-from-lowest"},
                                                        {"ListFromHighest", "list-from-highest"},
                                                        {"FirstMoved", "first-moved"},
                                                        {"MovesInOrder", "moves-in-order"},
                                                        {"HowManyMoves", "how-many-moves"},
                                                        {"HaveMoved", "have-moved"},
                                                        {"StartedWith", "started-with"},
                                                        {"DoneWith", "done-with"},
                                                        {"HowFarMoved", "how-far-moved"},
                                                        {"HowFar", "how-far"},
                                                        {"HowTall", "how-tall"},
                                                        {"HowWide", "how-wide"},
                                                        {"ClosestPair", "closest"},
                                                        {"FarthestPair", "farthest"},
                                                        {"WhatKept", "what-kept"},
                                                        {"MayTouch", "may-touch"},
                                                        {"Note", "note"},
                                                        {"PutAsNoted", "as-noted"}};
  auto result = asks_whether_possible ? std::string{"able"} : names.at(x.action);
  if (!x.things.empty())
    result +=
      ' ' + (x.number > 0 ? std::to_string(x.number) + " of " : std::string{}) + joined(x.things);
  for (const auto& place : x.places)
    result += ' ' + place.relation + (place.landmarks.empty() ? "" : " ") + joined(place.landmarks);
  return result + (x.by.empty() ? "" : ' ' + x.by);
}

std::string understood(const DirectiveSentences& x) {
  TableScene scene;
  lay_out(table, scene);
  TableTalk talk{[&](auto& asked) { return scene.reply(asked); },
                 [&](auto& told, auto features) { scene.tell(told, std::move(features)); },
                 words_of_requests()};
  Reply reply;
  for (const auto& sentence : x.said)
    reply = talk.say(sentence);
  std::string result;
  for (const auto& step : reply.steps)
    result += (result.empty() ? "" : "; ") + shown(step, reply.asks_whether_possible);
  if (!result.empty())
    result = (reply.corrects ? "correct " : reply.comes_first ? "first " : "") + result;
  return result.empty() ? "? " + reply.text : result;
}

bool is_right(const DirectiveSentences& x, const std::string& got) {
  if (!x.expected.starts_with('?'))
    return got == x.expected;
  const auto text = x.expected.substr(std::min<std::size_t>(2, x.expected.size()));
  return got.starts_with("? ") && got.find(text) != std::string::npos;
}

struct Figures {
  std::size_t all = 0;
  std::size_t right = 0;
  std::size_t asked_back = 0;
  std::string failures;
};

Figures figures_of(const std::string& file) {
  Figures result;
  for (const auto& x : directive_sentences(file)) {
    const auto got = understood(x);
    ++result.all;
    if (is_right(x, got))
      ++result.right;
    else {
      result.asked_back += got.starts_with("? ") ? 1 : 0;
      result.failures +=
        x.said.back() + "\n    is: " + got + "\n    should be: " + x.expected + '\n';
    }
  }
  ::testing::Test::RecordProperty("right", static_cast<int>(result.right));
  std::cout << file << ": " << result.right << " of " << result.all << " are understood, "
            << result.asked_back << " are not answered, "
            << result.all - result.right - result.asked_back << " are misunderstood\n";
  return result;
}

} // namespace

TEST(Directives, AllThatTheGrammarWasWrittenWithAreUnderstood) {
  const auto result = figures_of("dev.txt");
  EXPECT_GE(result.all, 150U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

TEST(Directives, WhatIsSaidOfOthersIsUnderstood) {
  const auto result = figures_of("conversation.txt");
  EXPECT_GE(result.all, 35U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

TEST(Directives, WhatIsSaidInOtherWaysIsUnderstood) {
  const auto result = figures_of("indirect.txt");
  EXPECT_GE(result.all, 55U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

TEST(Directives, WhatIsSaidInEverydayWordsIsUnderstood) {
  const auto result = figures_of("everyday.txt");
  EXPECT_GE(result.all, 70U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

TEST(Directives, WhatSaysTheSameIsUnderstood) {
  const auto result = figures_of("paraphrases.txt");
  EXPECT_GE(result.all, 70U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

TEST(Directives, PlainSentencesAreUnderstood) {
  const auto result = figures_of("plain.txt");
  EXPECT_GE(result.all, 55U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

/// One place, in each way to ask for it.
struct AskedPlace {
  std::string said;
  std::string meant;
};

TEST(Directives, APlaceIsTheSameInEachWayToAskForIt) {
  const std::vector<AskedPlace> places{{"on the left", "left"},
                                       {"at the back", "back"},
                                       {"in the middle", "centre"},
                                       {"in the centre of the table", "centre"},
                                       {"at the left edge", "left-edge"},
                                       {"at the front edge", "front-edge"},
                                       {"at the edge", "edge"},
                                       {"in the front left corner", "front-left-corner"},
                                       {"in the middle of the back edge", "back-edge centre"},
                                       {"next to the red box", "near c"},
                                       {"to the left of the red box", "left c"},
                                       {"in front of the red box", "front c"},
                                       {"behind the smaller box", "back d"},
                                       {"on the red box", "on c"},
                                       {"between the red box and the green box", "between c,d"},
                                       {"between the two boxes", "between c,d"},
                                       {"10 cm to the left of the red box", "left c"},
                                       {"where the red ball is", "where a"},
                                       {"on the right side of the table", "right"},
                                       {"on the left half of the table", "left"}};
  const std::vector<std::string> requests{"Put the blue ball",
                                          "Please place the blue ball",
                                          "Move the blue ball",
                                          "Set the blue ball down",
                                          "Take the blue ball and put it",
                                          "Pick up the blue ball and place it",
                                          "Lift the blue ball and set it down",
                                          "Could you put the blue ball",
                                          "I would like you to put the blue ball",
                                          "I want the blue ball",
                                          "I'd like the blue ball to be",
                                          "First take the blue ball, then put it",
                                          "The blue ball should be",
                                          "Make sure that the blue ball is",
                                          "Grab the blue ball and put it",
                                          "Would you mind putting the blue ball"};
  for (const auto& place : places)
    for (const auto& request : requests) {
      const auto said = request + ' ' + place.said + '.';
      const auto got = understood({{said}, {}});
      EXPECT_EQ(got.substr(got.rfind("; ") == got.npos ? 0 : got.rfind("; ") + 2),
                "put b " + place.meant)
        << said;
    }
}

TEST(Directives, WhatFollowsOnARequestIsUnderstood) {
  const auto result = figures_of("turns.txt");
  EXPECT_GE(result.all, 50U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

TEST(Directives, AnOrderOfColoursIsTheOneThatIsSaid) {
  const std::vector<ThingInSet> colours{{"blue", "cube", "blue", -0.2, 0, 0.05},
                                        {"red", "sphere", "red", 0, 0, 0.05},
                                        {"green", "cube", "green", 0.2, 0, 0.05},
                                        {"yellow", "cylinder", "yellow", 0.1, 0.15, 0.05}};
  for (const std::string said : {"Line them up: yellow, blue, red.",
                                 "Put them in a row in this order: yellow, blue and red.",
                                 "Arrange the things yellow, blue, red from left to right."}) {
    TableScene scene;
    lay_out(colours, scene);
    TableTalk talk{[&](auto& asked) { return scene.reply(asked); },
                   [&](auto& told, auto features) { scene.tell(told, std::move(features)); },
                   words_of_requests()};
    const auto steps = talk.say(said).steps;
    ASSERT_EQ(steps.size(), 1U) << said;
    EXPECT_EQ(shown(steps.front(), false), "put yellow,blue,red in-row-as-named") << said;
  }
}

TEST(Directives, WhatStandsOnEachOtherIsATower) {
  const auto talk_of = [](const std::vector<std::string>& said, bool is_stacked) {
    TableScene scene;
    lay_out(table, scene);
    if (is_stacked)
      scene.relate("on", "d", "c");
    TableTalk talk{[&](auto& asked) { return scene.reply(asked); },
                   [&](auto& told, auto features) { scene.tell(told, std::move(features)); },
                   words_of_requests()};
    Reply reply;
    for (const auto& x : said)
      reply = talk.say(x);
    return reply.steps.empty() ? reply.text : shown(reply.steps.front(), false);
  };
  EXPECT_EQ(talk_of({"Take the tower apart."}, true), "put d table");
  EXPECT_EQ(talk_of({"Dismantle the stack again."}, true), "put d table");
  EXPECT_EQ(talk_of({"How many things are in the tower?"}, true),
            "There are two things in the tower.");
  EXPECT_EQ(talk_of({"How many objects does the tower have?"}, true),
            "There are two things in the tower.");
  EXPECT_EQ(talk_of({"What is under the green box?"}, true), "There is a large red cube.");
  EXPECT_EQ(talk_of({"Take the thing under the green box."}, true), "take c");
  EXPECT_EQ(talk_of({"Take the tower apart."}, false), "I do not see a tower.");
  // What carries the box is not one of the others: it cannot be moved without it.
  const std::vector<std::string> others{"Put the green box on the red box.",
                                        "Move all the others to the left edge."};
  EXPECT_EQ(talk_of(others, true), "put a,b,e,f left-edge");
  EXPECT_EQ(talk_of(others, false), "put a,b,c,e,f left-edge");
}

TEST(Directives, MeasuredPlacesAndQuestionsAreUnderstood) {
  const auto result = figures_of("exact.txt");
  EXPECT_GE(result.all, 65U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

/// Before it was looked at, 63 of 70 were understood, 2 were not answered and 5 misunderstood.
TEST(Directives, AllThatWereLookedAtAfterwardsAreUnderstood) {
  const auto result = figures_of("heldout.txt");
  EXPECT_GE(result.all, 60U);
  EXPECT_EQ(result.right, result.all) << result.failures;
}

/// Whether an utterance is understood at all, by itself. Before it was looked at, 513 of 728 were.
TEST(Directives, MostOfWhatPeopleSayForEachIntentIsUnderstood) {
  const std::vector<ThingInSet> scattered{{"BB", "sphere", "blue", -0.16, -0.09, 0.06},
                                          {"RC", "cube", "red", 0.02, -0.02, 0.06},
                                          {"GC", "cube", "green", 0.20, -0.06, 0.05},
                                          {"YC", "cylinder", "yellow", -0.12, 0.06, 0.08},
                                          {"PB", "sphere", "purple", 0.15, 0.06, 0.055}};
  std::ifstream in{std::string{CASTOR_DIRECTIVES} + "/intents.txt"};
  std::size_t all = 0;
  std::size_t parsed = 0;
  std::string failures;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.starts_with('#'))
      continue;
    TableScene scene;
    lay_out(scattered, scene);
    TableTalk talk{[&](auto& asked) { return scene.reply(asked); },
                   [&](auto& told, auto features) { scene.tell(told, std::move(features)); },
                   words_of_requests()};
    ++all;
    if (talk.say(line).is_parsed)
      ++parsed;
    else
      failures += line + '\n';
  }
  ::testing::Test::RecordProperty("understood", static_cast<int>(parsed));
  std::cout << parsed << " of " << all << " are understood\n";
  EXPECT_EQ(all, 728U);
  EXPECT_GE(100 * parsed, 93 * all) << failures;
}

/// Before they were looked at, 44 of 65 were understood, 17 were not answered and 4 misunderstood.
TEST(Directives, MostOfFurtherOnesAreUnderstood) {
  const auto result = figures_of("heldout_2.txt");
  EXPECT_GE(result.all, 60U);
  EXPECT_GE(100 * result.right, 85 * result.all) << result.failures;
}

} // namespace castor::communication::test
