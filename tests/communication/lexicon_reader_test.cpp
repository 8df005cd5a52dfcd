#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

using namespace castor::communication;
using testing::HasSubstr;
using testing::SizeIs;

namespace {

const std::string head = "feature number sg pl\n"
                         "root np n[sg] n[pl]\n"
                         "family Noun\n"
                         "  n[?number]<x> : @x:thing(* ^ <Number>?number)\n";

std::string meaning(const std::string& lexicon, const std::string& utterance) {
  const auto read = read_lexicon(lexicon, "test.ccg");
  for (const auto& problem : read.problems)
    ADD_FAILURE() << render(problem);
  if (!read.lexicon)
    return {};
  const auto readings = Parser(read.lexicon).readings(utterance);
  return readings.empty() ? "nothing" : to_string(readings.front());
}

/// The only problem, as "line:column".
std::string problem(const std::string& lexicon) {
  const auto read = read_lexicon(lexicon, "test.ccg");
  EXPECT_THAT(read.problems, SizeIs(1));
  EXPECT_EQ(read.lexicon, nullptr);
  if (read.problems.empty())
    return {};
  const auto& first = read.problems.front();
  EXPECT_FALSE(first.remedy.empty());
  return std::to_string(first.where.line()) + ":" + std::to_string(first.column) + " " +
         first.message;
}

} // namespace

TEST(LexiconReader, MakesPluralsByRuleAndByException) {
  const auto lexicon = head + "nouns Noun\n  ball box cherry man/men item=object\n";
  EXPECT_EQ(meaning(lexicon, "ball"), "@w1:thing(ball ^ <Number>sg)");
  EXPECT_EQ(meaning(lexicon, "boxes"), "@w1:thing(box ^ <Number>pl)");
  EXPECT_EQ(meaning(lexicon, "cherries"), "@w1:thing(cherry ^ <Number>pl)");
  EXPECT_EQ(meaning(lexicon, "men"), "@w1:thing(man ^ <Number>pl)");
  EXPECT_EQ(meaning(lexicon, "items"), "@w1:thing(object ^ <Number>pl)");
  EXPECT_EQ(meaning(lexicon, "mans"), "nothing");
}

TEST(LexiconReader, KnowsPhrasesAndContinuedMeanings) {
  const auto lexicon = head + "family Where  # a comment\n"
                              "  (n[?number]<x>\\n[?number]<x>)/n<y>\n"
                              "    : @x(<Location>(r:region ^ *\n"
                              "    ^ <Anchor>(y)))\n"
                              "nouns Noun\n  ball box\n"
                              "words Where\n  next_to=near\n";
  EXPECT_EQ(meaning(lexicon, "ball next to box"),
            "@w1:thing(ball ^ <Number>sg ^ <Location>(w2:region ^ near ^ <Anchor>(w4:thing ^ box ^ "
            "<Number>sg)))");
}

TEST(LexiconReader, KnowsTheLongestPhraseThatEndsInAWord) {
  const auto read = read_lexicon(
    head + "nouns Noun\n  ball\nwords Noun[sg]\n  big_red_ball=ball\nfiller by_the_way\n",
    "test.ccg");
  ASSERT_NE(read.lexicon, nullptr);
  EXPECT_EQ(read.lexicon->longest_phrase_ending_in("ball"), 3U);
  EXPECT_EQ(read.lexicon->longest_phrase_ending_in("way"), 3U);
  EXPECT_EQ(read.lexicon->longest_phrase_ending_in("balls"), 1U);
  EXPECT_EQ(read.lexicon->longest_phrase_ending_in("red"), 1U);
  EXPECT_EQ(read.lexicon->longest_phrase_ending_in("unknown"), 1U);
}

TEST(LexiconReader, PrefersEntriesByTheirWeights) {
  const auto lexicon = head + "words Noun[sg]\n  bank=river{-2} bank=money{-1.5}\n";
  EXPECT_EQ(meaning(lexicon, "bank"), "@w1:thing(money ^ <Number>sg)");
}

TEST(LexiconReader, NamesThePlaceOfEveryMistake) {
  EXPECT_EQ(problem(head + "familly Verb\n"), "5:1 \"familly\" does not begin a line");
  EXPECT_EQ(problem(head + "words Nuon\n  ball\n").substr(0, 4), "5:7 ");
  EXPECT_EQ(problem(head + "words Noun[dual]\n"), "5:11 no feature has the value \"dual\"");
  EXPECT_EQ(problem(head + "family A\n  n[sg/n\n"), "6:7 a bracket is not closed");
  EXPECT_EQ(problem(head + "family A\n  n[some]\n"), "6:5 no feature has the value \"some\"");
  EXPECT_EQ(problem(head + "family A\n  n[?case]\n"), "6:5 there is no feature \"case\"");
  EXPECT_EQ(problem(head + "family A\n  n<x> : @x(<R>y\n"), "6:17 expected \")\"");
  EXPECT_EQ(problem(head + "family Noun\n"), "5:8 there is a family \"Noun\" already");
  EXPECT_EQ(problem(head + "words Noun\n  ball{x}\n"), "6:7 a weight is a number");
  EXPECT_EQ(problem(head + "words Noun\n  =ball\n"), "6:3 there is no word");
  EXPECT_EQ(problem("root np\n  ball\n").substr(0, 4), "2:3 ");
  EXPECT_EQ(problem("feature number sg\n"), "1:1 nothing says what an utterance may be");
}

TEST(LexiconReader, ReportsAllMistakesWithTheLineAndARemedy) {
  const auto read = read_lexicon(head + "words Noum\n  ball\nrot np\n", "my.ccg");
  ASSERT_THAT(read.problems, SizeIs(testing::Ge(2)));
  const auto text = render(read.problems.front());
  EXPECT_THAT(text, HasSubstr("my.ccg:5:7: error: there is no family \"Noum\""));
  EXPECT_THAT(text, HasSubstr("words Noum\n"));
  EXPECT_THAT(text, HasSubstr("did you mean 'Noun'?"));
}

RC_GTEST_PROP(LexiconReader, SurvivesAnything, ()) {
  static const std::vector<std::string> pieces = {
    "feature", "root", "raise", "family", "words", "nouns", "filler", "np",  "n[sg]", "(",
    ")",       "/",    "\\",    "[",      "]",     "<",     ">",      "<x>", ":",     " : ",
    "@x",      "^",    "&",     "*",      "{",     "}",     "{1}",    "=",   "?",     "\n",
    "\n  ",    " ",    "over",  "number", "A",     "\t",    "\r",     "#",   "_",     "'"};
  std::string text;
  for (const auto i : *rc::gen::container<std::vector<std::size_t>>(
         rc::gen::inRange<std::size_t>(0, pieces.size())))
    text += pieces[i] + (i % 3 == 0 ? " " : "");
  for (const auto& found : read_lexicon(text, "x").problems)
    RC_ASSERT(!found.remedy.empty());
}
