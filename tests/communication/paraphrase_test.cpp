#include "castor/communication/parsing/paraphrase.hpp"

#include "castor/communication/dialogue/reparsing.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace castor::communication::test {

namespace {

using testing::HasSubstr;

std::string joined(const std::vector<std::string>& words) {
  std::string result;
  for (const auto& word : words)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

/// What is said in other words; "-" if the paraphrase does not fit.
std::string said_by(const std::string& paraphrase, const std::string& utterance) {
  auto words = words_of(utterance);
  return Paraphrase{paraphrase}.apply(words) ? joined(words) : "-";
}

std::string problem_of(const std::string& paraphrase) {
  try {
    const Paraphrase unused{paraphrase};
    return {};
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
}

} // namespace

TEST(Paraphrase, WordsOfAPatternAreReplacedWhereverTheyStand) {
  EXPECT_EQ(said_by("wee = little", "the wee ball"), "the little ball");
  EXPECT_EQ(said_by("wee = little", "the small ball"), "-");
}

TEST(Paraphrase, AlternativesMayBeSeveralWordsAndMayBeMissing) {
  const std::string pattern = "take a_firm|good? hold of = take";
  EXPECT_EQ(said_by(pattern, "take a firm hold of it"), "take it");
  EXPECT_EQ(said_by(pattern, "take good hold of it"), "take it");
  EXPECT_EQ(said_by(pattern, "take hold of it"), "take it");
  EXPECT_EQ(said_by(pattern, "take a hold of it"), "-");
}

TEST(Paraphrase, SlotsKeepWhatIsSaidInThem) {
  const std::string pattern = "give X a push|shove = push X";
  EXPECT_EQ(said_by(pattern, "give the red ball a shove"), "push the red ball");
  EXPECT_EQ(said_by("how far X is from Y > = how far is X from Y", "how far the cube is from it"),
            "how far is the cube from it");
}

TEST(Paraphrase, SlotsDoNotGoOverPauses) {
  EXPECT_EQ(said_by("give X a push = push X", "give it, and a push"), "-");
  EXPECT_EQ(said_by("hand over X > = give me X", "hand over the cube, and then go"),
            "give me the cube , and then go");
}

TEST(Paraphrase, APatternMayHaveToBeginOrEndAPart) {
  EXPECT_EQ(said_by("< nah = no", "it is nah"), "-");
  EXPECT_EQ(said_by("< nah = no", "well, nah"), "well , no");
  EXPECT_EQ(said_by("< make room = clear", "could you make room"), "could you clear");
  EXPECT_EQ(said_by("though > =", "it is red though"), "it is red");
  EXPECT_EQ(said_by("though > =", "though it is red"), "-");
}

TEST(Paraphrase, WhatIsWrongInOneIsSaid) {
  EXPECT_THAT(problem_of("give X a push"), HasSubstr("what says the same"));
  EXPECT_THAT(problem_of("give X = take Y"), HasSubstr("has no \"Y\""));
  EXPECT_THAT(problem_of("X and X = X"), HasSubstr("twice"));
  EXPECT_THAT(problem_of("X maybe? = X"), HasSubstr("has to be said"));
  EXPECT_THAT(problem_of("on the @side = at the @side"),
              HasSubstr("no list has the name \"side\""));
}

TEST(Paraphrase, WhatIsSaidOfAListIsSaidInTheParaphrase) {
  const auto read = read_lexicon("root s\n"
                                 "list side left|right|left_hand\n"
                                 "paraphrases\n"
                                 "  clear|empty @side? side|half = clear the @side side\n",
                                 "some.words");
  ASSERT_TRUE(read.problems.empty());
  const auto said = [&](std::string_view words) {
    return joined(paraphrased(words_of(words), *read.lexicon, false).value());
  };
  EXPECT_EQ(said("empty right half"), "clear the right side");
  EXPECT_EQ(said("empty left hand half"), "clear the left hand side");
  EXPECT_EQ(said("empty half"), "clear the side");
}

TEST(Paraphrase, ListsAreNamedOnceAndHaveWords) {
  const auto read =
    read_lexicon("root s\nlist side left|right\nlist side front\nlist empty\n", "some.words");
  ASSERT_EQ(read.problems.size(), 2U);
  EXPECT_THAT(read.problems.front().message, HasSubstr("already"));
  EXPECT_THAT(read.problems.back().message, HasSubstr("a name and words"));
}

TEST(Paraphrase, OneThatIsWrongIsReportedWithItsLine) {
  const auto read = read_lexicon("root s\nparaphrases\n  give X = take Y\n", "some.words");
  ASSERT_EQ(read.problems.size(), 1U);
  EXPECT_EQ(read.problems.front().where.line(), 3U);
  EXPECT_THAT(read.problems.front().message, HasSubstr("has no \"Y\""));
  EXPECT_THAT(read.problems.front().remedy, HasSubstr("push X"));
}

TEST(Paraphrase, ReplacementsAreMadeInWhatIsUnderstoodToo) {
  const auto read = read_lexicon("root s\n"
                                 "paraphrases\n"
                                 "  nah = no\n"
                                 "replacements\n"
                                 "  kindly keep = please put\n",
                                 "some.words");
  ASSERT_TRUE(read.problems.empty());
  const auto& lexicon = *read.lexicon;
  EXPECT_EQ(joined(paraphrased(words_of("nah, kindly keep it there"), lexicon, true).value()),
            "nah , please put it there");
  EXPECT_EQ(joined(paraphrased(words_of("nah, kindly keep it there"), lexicon, false).value()),
            "no , please put it there");
  EXPECT_FALSE(paraphrased(words_of("put it there"), lexicon, false));
}

} // namespace castor::communication::test
