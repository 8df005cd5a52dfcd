#include "castor/communication/dialogue/function_words.hpp"

#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::communication {

namespace {

Parser& parser_of_hasty_speech() {
  static Parser parser{english_lexicon()};
  return parser;
}

std::optional<PackedLogicalForm> completed_form(const std::string& said) {
  return parsed_with_function_words(parser_of_hasty_speech(), words_of(said));
}

LogicalForm likeliest(const PackedLogicalForm& form) {
  return unpack(form, form.readings.front().id).front();
}

/// Whether the first utterance is taken for the second one.
bool is_taken_for(const std::string& said, const std::string& meant) {
  const auto form = completed_form(said);
  return form && equivalent(likeliest(*form), likeliest(parser_of_hasty_speech().parse(meant)));
}

/// What an utterance is said to be taken for; empty if that is not said.
std::string said_back_of(const std::string& said) {
  const auto form = completed_form(said);
  return !form                       ? "not understood"
         : form->corrections.empty() ? ""
                                     : form->corrections.front().meant;
}

} // namespace

TEST(FunctionWords, ArticlesMayBeMissing) {
  EXPECT_TRUE(is_taken_for("is cube yellow?", "is the cube yellow?"));
  EXPECT_TRUE(
    is_taken_for("is small red cube left of ball?", "is the small red cube left of the ball?"));
  EXPECT_TRUE(is_taken_for("what is colour of ball?", "what is the colour of the ball?"));
  EXPECT_TRUE(is_taken_for("is there cube?", "is there a cube?"));
  EXPECT_TRUE(is_taken_for("do you see red ball?", "do you see a red ball?"));
  EXPECT_TRUE(is_taken_for("is cube toy?", "is the cube a toy?"));
  EXPECT_TRUE(is_taken_for("ball is red", "the ball is red"));
  EXPECT_EQ(said_back_of("is cube yellow?"), "");
}

TEST(FunctionWords, NounsAndVerbsAreOfOneNumber) {
  EXPECT_TRUE(is_taken_for("how many ball are on the table", "how many balls are on the table"));
  EXPECT_TRUE(is_taken_for("which things is red", "which things are red"));
  EXPECT_TRUE(is_taken_for("how many thing is red", "how many things are red"));
  EXPECT_EQ(said_back_of("how many thing is red"), "");
}

TEST(FunctionWords, VerbsMayBeMissing) {
  EXPECT_TRUE(is_taken_for("where ball?", "where is the ball?"));
  EXPECT_TRUE(is_taken_for("what colour ball?", "what colour is the ball?"));
  EXPECT_TRUE(is_taken_for("cube red?", "is the cube red?"));
  EXPECT_TRUE(is_taken_for("ball left of cube?", "is the ball left of the cube?"));
  EXPECT_EQ(said_back_of("where ball?"), "where is the ball");
}

TEST(FunctionWords, MayStandElsewhere) {
  EXPECT_TRUE(is_taken_for("where the ball is?", "tell me where the ball is"));
  EXPECT_TRUE(is_taken_for("is red the cube?", "is the cube red?"));
  EXPECT_TRUE(is_taken_for("do you can see a ball?", "can you see a ball?"));
  EXPECT_TRUE(is_taken_for("does the ball is red?", "is the ball red?"));
}

TEST(FunctionWords, WordsAboutThingsAreNeitherAddedNorLeftOut) {
  for (auto* said :
       {"is the zorg red", "almost the cube red", "red the of", "if ball", "ball unless cube",
        "the ball", "red ball", "nearly cube yellow", "before ball red"})
    EXPECT_EQ(said_back_of(said), "not understood") << said;
}

TEST(FunctionWords, OfLongUtterancesAreNotLookedFor) {
  std::string said = "is cube yellow";
  for (int i = 0; i < 12; ++i)
    said += " and red";
  EXPECT_EQ(said_back_of(said), "not understood");
}

} // namespace castor::communication
