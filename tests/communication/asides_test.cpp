#include "castor/communication/dialogue/asides.hpp"
#include "castor/communication/dialogue/reparsing.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::communication {

namespace {

Parser& english_parser() {
  static Parser parser{english_lexicon()};
  return parser;
}

std::optional<PackedLogicalForm> reparsed_of(const std::string& said) {
  return reparsed(english_parser(), words_of(said), english_parser().parse(said));
}

LogicalForm first_reading(const PackedLogicalForm& form) {
  return unpack(form, form.readings.front().id).front();
}

/// Whether the first utterance is understood as the second one is, but for where its words stand.
bool is_understood_as(const std::string& said, const std::string& meant) {
  const auto form = reparsed_of(said);
  const auto core = english_parser().parse(meant);
  return form && equivalent(first_reading(*form), first_reading(core));
}

/// Parts that are said to be left out, joined by "/".
std::string left_out(const std::string& said) {
  const auto form = reparsed_of(said);
  std::string result;
  if (form)
    for (auto& x : form->corrections)
      result += (result.empty() ? "" : "/") + x.word + x.meant;
  return form ? result : "not understood";
}

} // namespace

TEST(Asides, AreLeftOutWhereverTheyStand) {
  EXPECT_TRUE(is_understood_as("lol is the cube like totally red bruh", "is the cube red"));
  EXPECT_TRUE(is_understood_as("For the record, is the cube red?", "is the cube red"));
  EXPECT_TRUE(is_understood_as("Hang on, the cube is red.", "the cube is red"));
  EXPECT_EQ(left_out("lol is the cube red"), "");
}

TEST(Asides, FramesBeforeAClauseAreLeftOut) {
  EXPECT_TRUE(is_understood_as("I do believe there is a cube.", "there is a cube"));
  EXPECT_TRUE(is_understood_as("My barkeeper tells me that the cube is red.", "the cube is red"));
  EXPECT_TRUE(is_understood_as("Forgive me for asking, but is the cube red?", "is the cube red"));
}

TEST(Asides, FramesAfterACommaAreLeftOut) {
  EXPECT_TRUE(is_understood_as("Is the cube red, would you say?", "is the cube red"));
  EXPECT_TRUE(
    is_understood_as("According to my notes, is the cube red, do you think?", "is the cube red"));
}

TEST(Asides, AndFramesAreLeftOutOfOneSentence) {
  EXPECT_TRUE(is_understood_as("lol, my barkeeper tells me that the cube is red, if I may say so",
                               "the cube is red"));
  EXPECT_EQ(left_out("lol, my barkeeper tells me that the cube is red, if I may say so"),
            "lol my barkeeper tells me that");
}

TEST(Asides, WhoIsToldAndWhoTellsAreLeftOut) {
  EXPECT_TRUE(
    is_understood_as("Zorg wants to know where the cube is.", "tell me where the cube is"));
  EXPECT_TRUE(
    is_understood_as("Tell the zorgs which things are red.", "tell me which things are red"));
  EXPECT_TRUE(is_understood_as("Mia believes the cube is red.", "the cube is red"));
  EXPECT_EQ(left_out("Mia believes the cube is red."), "");
}

TEST(Asides, BetweenCommasNeedNoPause) {
  EXPECT_TRUE(is_understood_as("Which things, if any, are red?", "which things are red"));
}

TEST(Asides, WordsOfASentenceAreNoAsides) {
  EXPECT_TRUE(
    is_understood_as("Quick check, is the cube on the right?", "is the cube on the right"));
  EXPECT_TRUE(is_understood_as("thx bro", "thx"));
}

TEST(Asides, WhatIsAskedForIsAskedFor) {
  EXPECT_TRUE(is_understood_as("I should like to know whether the cube is red.",
                               "tell me whether the cube is red"));
  EXPECT_TRUE(is_understood_as("We would be grateful to learn what colour the cube is.",
                               "tell me what colour the cube is"));
}

TEST(Asides, UnknownWordsThatAreLeftOutAreSaid) {
  EXPECT_EQ(left_out("My barkeeper tells me that the cube is red."), "my barkeeper tells me that");
  EXPECT_EQ(left_out("Gadzooks, is the cube red?"), "gadzooks");
  EXPECT_EQ(left_out("I do believe the cube is red."), "");
}

TEST(Asides, WhatMayMatterIsNotLeftOut) {
  for (auto* said :
       {"I doubt that the cube is red.", "Nearly everything is red.", "Upstairs, is there a cube?",
        "Yesterday, is the cube red?", "If I take away the discs, how many things are left?",
        "I wish there was a cube.", "I never said the cube is red.", "Is the cube heavy?",
        "Is the cube red, unless you moved it?", "Wooden things are red.",
        "Does my friend see the cube?", "I painted the cube.", "My zorg, what colour is it?",
        "Except for you, who is red?", "Suppose you moved it, where is the cube?",
        "Nobody tells me that the cube is red.", "Underwater, is there a cube?",
        "Those cubes, I adore.", "Forgive me, is the zorg red?"})
    EXPECT_EQ(left_out(said), "not understood") << said;
}

TEST(Asides, WhatIsUnderstoodIsLeftAsItIs) {
  EXPECT_FALSE(reparsed_of("Is the cube red?"));
}

TEST(Asides, ALexiconSaysWhichTheyAre) {
  const auto text =
    read_lexicon("feature form dcl\nroot s[dcl]\nfamily Word\n  s[dcl]<x> : @x:thing(*)\n"
                 "words Word\n  go\naside you_know\nframe say\nperson i\ndecisive no\n",
                 "small.ccg");
  ASSERT_TRUE(text.lexicon);
  EXPECT_TRUE(text.lexicon->is_in(WordClass::aside, "you know"));
  EXPECT_TRUE(text.lexicon->is_in(WordClass::frame, "say"));
  EXPECT_TRUE(text.lexicon->is_in(WordClass::person, "i"));
  EXPECT_TRUE(text.lexicon->is_in(WordClass::decisive, "no"));
  EXPECT_FALSE(text.lexicon->is_in(WordClass::aside, "say"));
  EXPECT_TRUE(text.lexicon->is_in_a_class("know"));
  EXPECT_FALSE(text.lexicon->knows("know"));
  EXPECT_EQ(text.lexicon->longest_aside(), 2u);
  Parser parser{text.lexicon};
  EXPECT_TRUE(parsed_without_asides(parser, {"you", "know", "go"}));
  EXPECT_FALSE(parsed_without_asides(parser, {"no", ",", "go"}));
}

} // namespace castor::communication
