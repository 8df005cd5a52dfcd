// What people say about a row of things on a table, one sentence after the other.
#include "castor/tests/communication/sentence_set.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

/// A red ball, a blue cube and a yellow cylinder from the left to the right; the cube is small.
const std::vector<ThingInSet> beside_each_other{{"a", "sphere", "red", -0.28, 0, 0.08},
                                                {"b", "cube", "blue", 0, 0.02, 0.04},
                                                {"c", "cylinder", "yellow", 0.28, -0.02, 0.08}};

/// An orange ball, a purple cylinder, a grey cube and a red triangle, each behind the one before.
const std::vector<ThingInSet> behind_each_other{{"a", "sphere", "orange", 0, -0.26, 0.04},
                                                {"b", "cylinder", "purple", 0, -0.09, 0.08},
                                                {"c", "cube", "grey", 0, 0.09, 0.04},
                                                {"d", "triangle", "red", 0, 0.26, 0.04}};

/// The reply to the last of several sentences.
std::string reply_to(const std::vector<ThingInSet>& things, const std::vector<std::string>& said) {
  TableScene table;
  lay_out(things, table);
  TableTalk talk{[&](auto& asked) { return table.reply(asked); },
                 [&](auto& told, auto features) { table.tell(told, std::move(features)); }};
  std::string reply;
  for (auto& sentence : said)
    reply = talk.say(sentence).text;
  return reply;
}

std::string in_row(const std::vector<std::string>& said) {
  return reply_to(beside_each_other, said);
}

std::string in_line(const std::vector<std::string>& said) {
  return reply_to(behind_each_other, said);
}

} // namespace

TEST(TableDialogue, WhatIsLeftOutIsWhatWasSaidBefore) {
  EXPECT_EQ(in_row({"Is the ball red?", "Is the cube?"}), "No, it is blue.");
  EXPECT_EQ(in_row({"Is the ball red?", "Is the cube?", "Is the ball?"}), "Yes.");
  EXPECT_EQ(in_row({"The cube is not small.", "Is the ball?"}), "No, it is large.");
  EXPECT_EQ(in_row({"Somebody told me that the ball is small.", "Is it?"}), "No, it is large.");
  EXPECT_EQ(in_row({"How many things are large?", "And how many aren't?"}), "There is one thing.");
  EXPECT_EQ(in_row({"Are they all large?", "Which one isn't?"}), "There is a small blue cube.");
  EXPECT_EQ(in_row({"What is the leftmost thing?", "And what comes next?"}),
            "It is a small blue cube.");
  EXPECT_EQ(in_row({"Is there a red ball?", "Is the cube?"}), "I do not know what that is about.");
  EXPECT_EQ(in_row({"Which are?"}), "I do not know what that is about.");
}

/// The cube is behind the ball, and to the right of it; the disc is rather to the right of both.
const std::vector<ThingInSet> diagonal{{"a", "sphere", "red", -0.05, -0.06, 0.04},
                                       {"b", "cube", "blue", 0, 0.06, 0.04},
                                       {"c", "cylinder", "green", 0.25, -0.04, 0.04}};

TEST(TableDialogue, WhatIsRatherOnTheNextSideIsTold) {
  EXPECT_EQ(reply_to(diagonal, {"Is the ball to the left of the cube?"}),
            "Partly. It is in front of the cube.");
  EXPECT_EQ(reply_to(diagonal, {"Is the ball in front of the cube?"}), "Yes.");
  EXPECT_EQ(reply_to(diagonal, {"Is the ball behind the cube?"}), "No.");
  EXPECT_EQ(reply_to(diagonal, {"What is in front of the cube?"}), "There is a small red ball.");
  EXPECT_EQ(reply_to(diagonal, {"What is behind the cylinder?"}), "There is a small blue cube.");
  EXPECT_EQ(reply_to(diagonal, {"Is there anything behind the cylinder?"}),
            "There is a small blue cube.");
  EXPECT_EQ(reply_to(diagonal, {"What is in front of the ball?"}), "There is nothing.");
}

TEST(TableDialogue, EndsOfAStackAreTold) {
  TableScene table;
  lay_out(beside_each_other, table);
  table.relate("on", "a", "b");
  table.relate("on", "b", "c");
  TableTalk talk{[&](auto& asked) { return table.reply(asked); }};
  EXPECT_EQ(talk.say("What is at the bottom?").text, "There is a large yellow cylinder.");
  EXPECT_EQ(talk.say("Which one is on top?").text, "There is a large red ball.");
  EXPECT_EQ(talk.say("Which one is at the very bottom?").text, "There is a large yellow cylinder.");
}

TEST(TableDialogue, PhrasesSaidAsQuestionsAskWhatThereIs) {
  EXPECT_EQ(in_row({"A cube?"}), "Yes.");
  EXPECT_EQ(in_row({"Green things?"}), "No.");
  EXPECT_EQ(in_row({"Red ball."}), "What about it?");
  EXPECT_EQ(in_row({"Smallest thing?"}), "There is a small blue cube.");
  EXPECT_EQ(in_row({"How many balls are red?", "And blue cubes?"}), "There is one blue cube.");
}

TEST(TableDialogue, HastySpeechIsSaidBackIfMoreThanArticlesIsMissing) {
  EXPECT_EQ(in_row({"is cube blue"}), "Yes.");
  EXPECT_EQ(in_row({"where cube"}), "I take 'where cube' for 'where is the cube'. It is to the "
                                    "right of the ball.");
  EXPECT_EQ(in_row({"total object count"}), "There are three objects.");
}

TEST(TableDialogue, WhatBelongsToWhomIsNotKnown) {
  EXPECT_EQ(in_row({"The ball belongs to Mia."}), "Ok.");
  EXPECT_EQ(in_row({"The ball belongs to Mia.", "Who owns the ball?"}), "I do not know.");
  EXPECT_EQ(in_row({"The cube is Mia's bed.", "Where is the bed?"}),
            "It is to the right of the ball.");
}

TEST(TableDialogue, SmallTalkHasAnswers) {
  EXPECT_EQ(in_row({"My name is Tom."}), "Hello.");
  EXPECT_EQ(in_row({"Hiii robot!"}), "Hello.");
  EXPECT_EQ(in_row({"Thank you so much, that was lovely."}), "You are welcome.");
  EXPECT_EQ(in_row({"You are so clever!"}), "Thank you.");
  EXPECT_EQ(in_row({"I'm off, see you tomorrow!"}), "Bye.");
}

TEST(TableDialogue, CorrectionsSayWhatWasMeant) {
  EXPECT_EQ(in_row({"What colour is the ball?", "No, not the ball, the cube."}), "It is blue.");
  EXPECT_EQ(in_row({"What colour is the ball?", "I meant the cube, not the ball."}), "It is blue.");
  EXPECT_EQ(in_row({"What colour is the ball?", "The cube rather than the ball."}), "It is blue.");
}

TEST(TableDialogue, OthersAreOtherThanWhatIsSpokenOf) {
  EXPECT_EQ(in_row({"What is the small thing?", "What else is on the table?"}),
            "There is a large red ball and a large yellow cylinder.");
  EXPECT_EQ(in_row({"Is anything red?", "What else is large?"}),
            "There is a large yellow cylinder.");
  EXPECT_EQ(in_row({"Which thing is smaller than all the others?"}), "There is a small blue cube.");
  EXPECT_EQ(in_row({"Is the cube larger than the others?"}), "No.");
}

TEST(TableDialogue, DirectlyBehindMeansWithNothingBetween) {
  EXPECT_EQ(in_line({"What is directly behind the cylinder?"}), "There is a small grey cube.");
  EXPECT_EQ(in_line({"Is the cube directly behind the ball?"}), "No.");
  EXPECT_EQ(in_line({"What is just in front of the triangle?"}), "There is a small grey cube.");
  EXPECT_EQ(in_line({"Is anything immediately behind the triangle?"}), "No.");
}

TEST(TableDialogue, WhatIsNeitherNearNorFarIsNotKnown) {
  EXPECT_EQ(in_line({"Is the triangle far from the ball?"}), "Yes.");
  EXPECT_EQ(in_line({"Is the cube far from the cylinder?"}), "I do not know.");
}

TEST(TableDialogue, ThingsHaveOthersBesideThem) {
  EXPECT_EQ(in_line({"Which thing has the ball in front of it and the triangle behind it?"}),
            "There is a large purple cylinder and a small grey cube.");
  EXPECT_EQ(in_line({"Which thing has nothing behind it?"}), "There is a small red triangle.");
}

TEST(TableDialogue, NotAsLargeIsSmaller) {
  EXPECT_EQ(in_row({"Which things aren't as large as the ball?"}), "There is a small blue cube.");
  EXPECT_EQ(in_row({"Is the ball not as large as the cube?"}), "No.");
}

TEST(TableDialogue, QualitiesAreTheSameOrDiffer) {
  EXPECT_EQ(in_row({"Do the ball and the cylinder differ in size?"}), "No.");
  EXPECT_EQ(in_row({"Which two things have the same size?"}),
            "There is a large red ball and a large yellow cylinder.");
  EXPECT_EQ(in_row({"Which thing has a different size from all the others?"}),
            "There is a small blue cube.");
  EXPECT_EQ(in_row({"All the same size?"}), "No.");
}

TEST(TableDialogue, WhatPeopleNameIsKnownByItsName) {
  EXPECT_EQ(in_row({"The red ball is a tomato.", "What colour is the tomato?"}), "It is red.");
}

} // namespace castor::communication::test
