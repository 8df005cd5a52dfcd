#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <gtest/gtest.h>

using namespace castor::communication;

namespace {

DialogueMoveType move(const std::string& utterance) {
  static Parser parser(english_lexicon());
  const auto readings = parser.readings(utterance);
  EXPECT_FALSE(readings.empty()) << utterance;
  return readings.empty() ? DialogueMoveType::none : dialogue_move_type(readings.front());
}

} // namespace

TEST(DialogueMoveType, IsThatOfTheMood) {
  EXPECT_EQ(move("this is a blue square"), DialogueMoveType::assertion);
  EXPECT_EQ(move("there is a ball"), DialogueMoveType::assertion);
  EXPECT_EQ(move("no, it is red"), DialogueMoveType::assertion);
  EXPECT_EQ(move("put the cup near the box"), DialogueMoveType::action_directive);
  EXPECT_EQ(move("take the ball and put it on the box"), DialogueMoveType::action_directive);
  EXPECT_EQ(move("what do you see"), DialogueMoveType::question_w);
  EXPECT_EQ(move("how many red things are there"), DialogueMoveType::question_w);
  EXPECT_EQ(move("which objects are blue"), DialogueMoveType::question_w);
  EXPECT_EQ(move("is the ball red"), DialogueMoveType::question_yn);
  EXPECT_EQ(move("can you see the ball"), DialogueMoveType::question_yn);
}

TEST(DialogueMoveType, IsThatOfTheMarker) {
  EXPECT_EQ(move("hello"), DialogueMoveType::opening);
  EXPECT_EQ(move("good bye"), DialogueMoveType::closing);
  EXPECT_EQ(move("yes"), DialogueMoveType::accept);
  EXPECT_EQ(move("ok"), DialogueMoveType::accept);
  EXPECT_EQ(move("no"), DialogueMoveType::reject);
}

TEST(DialogueMove, IsARequestIfTheRobotDoesWhatTheVerbSays) {
  Parser parser(english_lexicon());
  WordMeanings nothing;
  WordMeanings finding;
  finding.actions["find"] = "Find";
  for (const auto* text : {"find the book", "look for the book", "search for the book"}) {
    DialogueMove said;
    for (const auto& reading : parser.readings(text)) {
      auto& form = said.content.nominals.empty() ? said.content : said.alternatives.emplace_back();
      form = reading;
    }
    said.type = dialogue_move_type(said.content);
    auto heard = said;
    take_requests(heard, nothing);
    EXPECT_EQ(heard.type, said.type) << text;
    EXPECT_EQ(heard.content, said.content) << text;
    take_requests(heard, finding);
    EXPECT_EQ(heard.type, DialogueMoveType::action_directive) << text;
    EXPECT_EQ(action_asked_for(heard.content, finding), "Find") << text;
    EXPECT_EQ(heard.alternatives.size(), said.alternatives.size()) << text;
  }
}

TEST(DialogueMoveType, IsNoneOfWhatIsNoSentence) {
  EXPECT_EQ(move("the ball to the right of the box"), DialogueMoveType::none);
  EXPECT_EQ(dialogue_move_type({}), DialogueMoveType::none);
}
