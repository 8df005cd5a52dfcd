#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <gmock/gmock.h>

using namespace castor::communication;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

PackedLogicalForm parse(const std::string& utterance) {
  static Parser parser(english_lexicon());
  return parser.parse(utterance);
}

} // namespace

TEST(Parser, NamesUnknownWordsAndWhatMayHaveBeenMeant) {
  const auto packed = parse("put the bxo near the skware thing");
  ASSERT_THAT(packed.unparsable, SizeIs(2));
  EXPECT_EQ(packed.unparsable[0].first_word, 2);
  EXPECT_EQ(packed.unparsable[0].words, 1);
  EXPECT_EQ(packed.unparsable[0].text, "bxo");
  EXPECT_EQ(packed.unparsable[0].reason, "the word \"bxo\" is not known");
  EXPECT_THAT(packed.unparsable[0].suggestions, Contains("box"));
  EXPECT_THAT(packed.unparsable[1].suggestions, Contains("square"));
}

TEST(Parser, KeepsWhatItUnderstoodBesideAnUnknownWord) {
  const auto packed = parse("zorg the blue square");
  ASSERT_THAT(packed.unparsable, SizeIs(1));
  ASSERT_THAT(packed.readings, SizeIs(1));
  EXPECT_THAT(to_string(unpack(packed, 0).at(0)), HasSubstr("square"));
}

TEST(Parser, SaysWhereTheAnalysisBroke) {
  const auto packed = parse("the ball the box");
  ASSERT_THAT(packed.unparsable, SizeIs(1));
  EXPECT_EQ(packed.unparsable[0].first_word, 2);
  EXPECT_EQ(packed.unparsable[0].reason, "\"the box\" does not go with \"the ball\" before it");
}

TEST(Parser, TakesNoWordsBetweenQuotationsForAQuotation) {
  const auto packed = parse("'Bob' is red and 'Ann' is blue");
  ASSERT_THAT(packed.unparsable, testing::Not(IsEmpty()));
  EXPECT_EQ(packed.unparsable[0].text, "is red");
}

TEST(Parser, SaysWhatIsMissing) {
  const auto packed = parse("put the ball");
  ASSERT_THAT(packed.unparsable, SizeIs(1));
  EXPECT_EQ(packed.unparsable[0].first_word, 3);
  EXPECT_EQ(packed.unparsable[0].reason, "\"put the ball\" is incomplete: a place is missing");
}

TEST(Parser, RefusesWhatDoesNotAgree) {
  EXPECT_THAT(parse("the balls is red").unparsable, testing::Not(IsEmpty()));
  EXPECT_THAT(parse("a balls").unparsable, testing::Not(IsEmpty()));
  EXPECT_THAT(parse("all ball are red").unparsable, testing::Not(IsEmpty()));
  EXPECT_THAT(parse("the balls are red").unparsable, IsEmpty());
}

TEST(Parser, HasNothingToSayOfNothing) {
  const auto packed = parse("");
  EXPECT_THAT(packed.readings, IsEmpty());
  ASSERT_THAT(packed.unparsable, SizeIs(1));
  EXPECT_EQ(packed.unparsable[0].reason, "there are no words");
}

TEST(Parser, StopsListeningAtItsLimit) {
  std::string text = "the";
  for (int i = 0; i < 100; ++i)
    text += " red";
  const auto packed = parse(text + " ball");
  ASSERT_THAT(packed.unparsable, testing::Not(IsEmpty()));
  EXPECT_EQ(packed.string_position, 48);
  EXPECT_THAT(packed.unparsable.back().reason, HasSubstr("at most 48 words"));
}

TEST(Parser, UnitesNoMeaningsThatContradictEachOther) {
  const auto read = read_lexicon("root n\n"
                                 "family Noun\n  n<x> : @x:thing(*)\n"
                                 "family Of\n  n<x>/n<x> : @x:*\n"
                                 "words Noun\n  ball\n"
                                 "words Of\n  solid=thing liquid=stuff\n",
                                 "test.ccg");
  ASSERT_NE(read.lexicon, nullptr);
  Parser parser(read.lexicon);
  EXPECT_THAT(parser.readings("solid ball"), SizeIs(1));
  EXPECT_THAT(parser.readings("liquid ball"), IsEmpty());
}

TEST(Parser, KeepsThePreferredEdgesWhereThereAreTooMany) {
  const auto read = read_lexicon("root a b c\n"
                                 "family A\n  a<x> : @x:a {-1}\n"
                                 "family B\n  b<x> : @x:b\n"
                                 "family C\n  c<x> : @x:c {-2}\n"
                                 "words A\n  word\nwords B\n  word\nwords C\n  word\n",
                                 "test.ccg");
  ASSERT_NE(read.lexicon, nullptr);
  ParserOptions options;
  EXPECT_THAT(Parser(read.lexicon, options).readings("word"), SizeIs(3));
  options.chart.edges_per_span = 1;
  const auto readings = Parser(read.lexicon, options).readings("word");
  ASSERT_THAT(readings, SizeIs(1));
  EXPECT_EQ(to_string(readings[0]), "@x1a:b");
}
