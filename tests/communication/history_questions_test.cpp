#include "castor/communication/dialogue/history_questions.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::communication {

namespace {

std::string question(const std::string& said) {
  std::string result;
  for (const auto& word : question_about_moves(words_of(said)).value_or(std::vector<std::string>{}))
    result += (result.empty() ? "" : " ") + word;
  return result;
}

} // namespace

TEST(HistoryQuestions, AskWhatWasMoved) {
  for (const auto* said :
       {"How many have you moved so far?", "which pieces were moved?", "How many did you touch?",
        "And now tell me how many things you have moved since we began.",
        "what have you displaced until now"})
    EXPECT_EQ(question(said), "which things have you moved") << said;
  EXPECT_EQ(question("How many balls have been shifted so far?"), "which balls have you moved");
  EXPECT_EQ(question("what have you just moved"), "which things have you moved for that");
  EXPECT_EQ(question("tell me what has not been moved"), "which things have you not moved");
  EXPECT_EQ(question("which cubes did you not touch"), "which cubes have you not moved");
}

TEST(HistoryQuestions, AskWhatWasMovedForTheLastRequest) {
  for (const auto* said :
       {"How many objects did you have to move for that?", "which things were moved by that?",
        "What have you moved in doing so?", "which things have you moved since the last request"})
    EXPECT_EQ(question(said), "which things have you moved for that") << said;
}

TEST(HistoryQuestions, AskWhatWasDoneLastOrFirst) {
  EXPECT_EQ(question("Describe in one sentence what you have just done."), "what did you do last");
  EXPECT_EQ(question("What have you done since the start?"), "in which order did you move them");
  EXPECT_EQ(question("which one did you move for me last"), "what did you move last");
  EXPECT_EQ(question("what have you moved first of all"), "what did you move first");
  EXPECT_EQ(question("Which one have you chosen?"), "which one did you move last");
}

TEST(HistoryQuestions, AskHowManyMovesThereWereAndInWhichOrder) {
  EXPECT_EQ(question("how many steps have you made in total"), "how many moves have you made");
  EXPECT_EQ(question("how often did you change that"), "how many moves have you made");
  EXPECT_EQ(question("In what sequence did you move them?"), "in which order did you move them");
}

TEST(HistoryQuestions, AskNothingElse) {
  for (const auto* said :
       {"what have you put on the cube?", "which thing is on the left?", "what do you see?",
        "how many balls are there?", "where did you put the ball?", "move the ball",
        "what did you do with the ball?", "which ball did you see?", "how far have you moved it?",
        "what did you say?", "which things were moved by us?", "which one did you not choose?",
        "how many times did you say that?", "", "which"})
    EXPECT_EQ(question(said), "") << said;
}

} // namespace castor::communication
