#include "castor/communication/parsing/word_meanings.hpp"

#include "castor/base/ontology_reader.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::communication::test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

const std::string shared_grammar = "feature number sg pl\n"
                                   "root np n[sg] n[pl]\n"
                                   "family Noun\n"
                                   "  n[?number]<x> : @x:thing(* ^ <Number>?number)\n";

LexiconText read_words(const std::string& words) {
  const std::vector<NamedText> files{{"shared.ccg", shared_grammar}, {"robot.words", words}};
  return read_lexicon(files);
}

Vocabulary vocabulary_of(const std::string& words, const std::string& concepts) {
  const auto lexicon = read_words(words);
  EXPECT_EQ(render(lexicon.problems), "");
  const std::vector<NamedText> files{{"robot.ontology", concepts}};
  return {lexicon.lexicon, std::make_shared<const Ontology>(read_ontology(files).statements)};
}

Nominal phrase_with(const std::string& word) {
  return {"x", "thing", word, {}, {}};
}

} // namespace

TEST(LexiconFiles, UseTheFamiliesOfEarlierOnes) {
  const auto robot = read_words("nouns Noun\n  shelf/shelves\nnouns Noun\n  shelf/shelves\n");
  ASSERT_THAT(robot.problems, IsEmpty());
  EXPECT_EQ(robot.lexicon->find("shelf").size(), 1U) << "the same word twice is one word";
  EXPECT_EQ(robot.lexicon->find("shelves").size(), 1U);
}

TEST(LexiconFiles, AreNamedInFindings) {
  EXPECT_THAT(render(read_words("nouns Noum\n  shelf\n").problems),
              HasSubstr("robot.words:1:7: error: there is no family \"Noum\""));
  EXPECT_THAT(render(read_words("general thing\nquality colour=color\n").problems),
              HasSubstr("robot.words:2:9: error: no kind of features is called \"color\""));
  EXPECT_THAT(render(read_words("value shap square\n").problems), HasSubstr("there is no quality"));
  EXPECT_THAT(render(read_words("look flat\n").problems), HasSubstr("does not say what looks so"));
  EXPECT_THAT(render(read_words("side wall lefft\n").problems), HasSubstr("no side is called"));
  EXPECT_THAT(render(read_words("surroundings table\n").problems), HasSubstr("by which word"));
  EXPECT_THAT(render(read_words("action put=\n").problems), HasSubstr("there is no word"));
  EXPECT_THAT(render(read_words("relatoin near\n").problems),
              HasSubstr("did you mean 'relation'?"));
}

TEST(Vocabulary, TellsWhatNounsStandFor) {
  const auto words = vocabulary_of("general thing object\nconcept disk=disc\nquality shape\n",
                                   "concept thing place\ndisjoint thing place\n"
                                   "concept disc: thing with shape circle\n"
                                   "concept room: place\nconcept kitchen: room");
  EXPECT_EQ(words.concept_of("disk"), "disc");
  EXPECT_EQ(words.concept_of("zorg"), "zorg");
  EXPECT_EQ(words.shape_of("disk"), "circle");
  EXPECT_EQ(words.noun_of_shape("circle"), "disc");
  EXPECT_TRUE(words.is_general("object"));
  EXPECT_TRUE(words.is_of_general_kind("disk"));
  EXPECT_TRUE(words.is_of_other_kind("kitchen"));
  EXPECT_FALSE(words.is_of_other_kind("zorg"));
  EXPECT_FALSE(words.is_of_general_kind("zorg"));
  EXPECT_EQ(words.kind_noun("kitchen"), "room");
  EXPECT_EQ(words.kind_noun("room"), "room");
}

TEST(Vocabulary, TellsWhatOtherWordsStandFor) {
  const auto words = vocabulary_of("quality shape hue=colour\n"
                                   "value shape square cubical=cube\n"
                                   "look flat shape square circle ?round\n"
                                   "relation near next_to=near\n"
                                   "surroundings floor on at\nsurroundings scene in\n"
                                   "addressee self\naction put=PickAndPlace\n"
                                   "reply thanks You are welcome.\nside wall left right\n",
                                   "");
  EXPECT_EQ(words.kind_of_quality("hue"), binding::FeatureKind::colour);
  EXPECT_EQ(words.kind_of_quality("weight"), std::nullopt);
  EXPECT_EQ(words.value_of("shape", "cubical"), "cube");
  EXPECT_EQ(words.value_of("shape", "fluffy"), std::nullopt);
  EXPECT_EQ(words.value_of("hue", "red"), "red") << "all words are values if none is listed";
  ASSERT_NE(words.look("flat"), nullptr);
  EXPECT_TRUE(words.look("flat")->unknown.contains("round"));
  EXPECT_EQ(words.relation_of("next_to"), "near");
  EXPECT_TRUE(words.is_spatial_relation("near"));
  EXPECT_FALSE(words.is_spatial_relation("next_to"));
  ASSERT_NE(words.surroundings(phrase_with("floor")), nullptr);
  EXPECT_THAT(words.surroundings(phrase_with("floor"))->regions, ElementsAre("on", "at"));
  EXPECT_EQ(words.surroundings(phrase_with("table")), nullptr);
  EXPECT_EQ(words.addressee(), "self");
  EXPECT_EQ(words.meanings().replies.at("thanks"), "You are welcome.");
  ASSERT_NE(words.side("wall"), nullptr);
  EXPECT_TRUE(words.side("wall")->right);
  EXPECT_FALSE(words.side("wall")->top);
}

TEST(Vocabulary, NamesTheActionsThatRequestsAskFor) {
  const auto words = vocabulary_of("action put=PickAndPlace\n", "");
  const LogicalForm put{"w1", {{"w1", "action", "put", {{"Mood", "imp"}}, {}}}, 0};
  const LogicalForm sing{"w1", {{"w1", "action", "sing", {{"Mood", "imp"}}, {}}}, 0};
  EXPECT_EQ(action_asked_for(put, words.meanings()), "PickAndPlace");
  EXPECT_EQ(action_asked_for(sing, words.meanings()), "");
}

} // namespace castor::communication::test
