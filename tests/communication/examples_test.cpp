#include "castor/communication/parsing/examples.hpp"

#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/stem.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/tests/communication/directive_sentences.hpp"
#include "castor/tests/communication/sentence_set.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// What utterances mean that are like sentences whose meaning is known.
namespace castor::communication::test {

namespace {

using testing::HasSubstr;
using Sentences = std::vector<std::pair<std::string, std::string>>;

const Sentences known_sentences{{"put X to the left of Y", "X goes on Y's left"},
                                {"put X to the left of Y", "left of Y is where X lives"},
                                {"swap X and Y", "X and Y trade places"},
                                {"swap X and Y", "X where Y is and Y where X is"},
                                {"move X 5 cm to the left", "5 cm left with X"},
                                {"do not touch X", "never handle X"},
                                {"do not touch X", "X stays as X is"},
                                {"take X", "handle X"}};

Examples examples_of(const Sentences& added) {
  Examples result;
  for (const auto& [meaning, sentence] : added)
    result.add(meaning, sentence);
  return result;
}

/// Things are in brackets: "[the red ball] goes on [it] 's left".
std::vector<ExamplePiece> pieces_of(const std::string& said) {
  std::vector<ExamplePiece> result;
  std::istringstream in{said};
  bool is_name = false;
  for (std::string word; in >> word;) {
    const bool begins = word.front() == '[';
    const bool ends = word.back() == ']';
    const auto plain = word.substr(begins ? 1 : 0, word.size() - (begins ? 1 : 0) - (ends ? 1 : 0));
    if (begins || !is_name)
      result.push_back({{}, begins});
    result.back().words.push_back(plain);
    is_name = (is_name || begins) && !ends;
  }
  return result;
}

std::string text_of_words(const std::vector<std::string>& words) {
  std::string result;
  for (const auto& word : words)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

/// The likeliest meaning; "-" if there is none.
std::string meaning_of(const std::string& said, const Sentences& added = known_sentences) {
  const auto found = examples_of(added).likeliest(pieces_of(said), 1);
  return found.empty() ? "-" : text_of_words(found.front().meaning);
}

double likeness_of(const std::string& said) {
  const auto found = examples_of(known_sentences).likeliest(pieces_of(said), 1);
  return found.empty() ? 0 : found.front().likeness;
}

std::string problem_of(const std::string& meaning, const std::string& sentence) {
  try {
    Examples{}.add(meaning, sentence);
    return {};
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
}

TEST(Examples, GiveTheMeaningOfWhatIsLikeThem) {
  EXPECT_EQ(meaning_of("[the ball] goes on [the red cube] 's left"),
            "put the ball to the left of the red cube");
  EXPECT_EQ(meaning_of("and [it] goes on the left of [the cube]"),
            "put it to the left of the cube");
  EXPECT_EQ(meaning_of("[it] and [that] should be trading places"), "swap it and that");
}

TEST(Examples, KeepThePlacesOfThings) {
  EXPECT_EQ(meaning_of("left of [the cube] is where [the ball] lives"),
            "put the ball to the left of the cube");
}

TEST(Examples, StandForTheOtherSideToo) {
  EXPECT_EQ(meaning_of("[the ball] goes on [the cube] 's right"),
            "put the ball to the right of the cube");
}

TEST(Examples, TakeOverNumbers) {
  EXPECT_EQ(meaning_of("12 cm right with [the ball]"), "move the ball 12 cm to the right");
  EXPECT_NE(meaning_of("a bit left with [the ball]"), "move the ball 5 cm to the left");
}

TEST(Examples, NeedTheSameThingInTheSameSlot) {
  EXPECT_EQ(meaning_of("[a] where [b] is and [b] where [a] is"), "swap a and b");
  EXPECT_NE(meaning_of("[a] where [b] is and [c] where [d] is"), "swap a and b");
}

TEST(Examples, NeedAsManyThings) {
  EXPECT_EQ(meaning_of("[a] and [b] and [c] trade places"), "-");
}

TEST(Examples, NeverMeanTheOppositeOfWhatIsSaid) {
  EXPECT_EQ(meaning_of("never handle [it]"), "do not touch it");
  EXPECT_EQ(meaning_of("handle [it]"), "take it");
  EXPECT_LT(likeness_of("do n't handle [it]"), 0.05);
}

TEST(Examples, AreTheSameAsThemselvesOnly) {
  const auto same = likeness_of("[the ball] and [the cube] trade places");
  EXPECT_GT(same, 0.8);
  EXPECT_LE(same, 1);
  EXPECT_LT(likeness_of("[the ball] and [the cube] trade stamps"), same);
  EXPECT_LT(likeness_of("[the ball] is round"), 0.2);
}

TEST(Examples, WeighWordsOfFewMeaningsMore) {
  const Sentences added{{"take X", "could you grab X"},
                        {"give me X", "could you pass X"},
                        {"push X", "could you shove X"}};
  EXPECT_EQ(meaning_of("you could pass [it]", added), "give me it");
  EXPECT_EQ(meaning_of("shove [it]", added), "push it");
}

TEST(Examples, MayNameThingsThatTheirMeaningDoesNot) {
  const Sentences added{{"that is a remark", "X wobbles"}, {"take X", "grab X"}};
  EXPECT_EQ(meaning_of("[the cube] wobbles", added), "that is a remark");
  const auto examples = examples_of(added);
  EXPECT_GT(examples.certainty_of("that is a remark", pieces_of("[it] wobbles")), 0);
  EXPECT_LT(examples.certainty_of("that is a remark", pieces_of("grab [it]")), 0);
  EXPECT_EQ(examples.certainty_of("swap X and Y", pieces_of("grab [it]")), 0);
}

TEST(Examples, NameWhatIsWrong) {
  EXPECT_EQ(problem_of("put X on Y", "X goes there"), "it does not have Y of its meaning");
  EXPECT_EQ(problem_of("take X", "X goes on Y"), "its meaning does not have Y");
  EXPECT_EQ(problem_of("put X on the left", "X goes there"),
            "it does not say left or right, as its meaning does");
}

TEST(Stems, AreTheSameForAllFormsOfAWord) {
  EXPECT_EQ(stem_of("sorted"), stem_of("sorting"));
  EXPECT_EQ(stem_of("places"), stem_of("place"));
  EXPECT_NE(stem_of("place"), stem_of("play"));
  EXPECT_EQ(stem_of("zürich"), "zürich");
}

TEST(LexiconReader, NamesTheLineOfAnExampleThatIsWrong) {
  const auto read = read_lexicon("root s\nexamples take X\n  grab it\n", "my.words");
  ASSERT_EQ(read.problems.size(), 1U);
  EXPECT_EQ(read.problems.front().where.line(), 3U);
  EXPECT_THAT(read.problems.front().message, HasSubstr("does not have X"));
}

// -- The examples of the lexicon

/// Those of the file, each with its meaning.
Sentences sentences_of_lexicon() {
  Sentences result;
  for (const auto& file : shared_lexicon_files()) {
    if (file.name != "examples.words")
      continue;
    std::istringstream in{file.text};
    std::string meaning;
    for (std::string line; std::getline(in, line);)
      if (line.starts_with("examples "))
        meaning = line.substr(9);
      else if (line.starts_with("  "))
        result.emplace_back(meaning, line.substr(2));
  }
  return result;
}

std::vector<std::string> with_things(const std::string& meaning) {
  std::vector<std::string> result;
  const bool is_of_kind = meaning == "how many X are there";
  for (auto& word : words_of(meaning)) {
    const auto* thing = word == "x"   ? (is_of_kind ? "cubes" : "the red cube")
                        : word == "y" ? "the blue ball"
                        : word == "z" ? "the green cube"
                                      : nullptr;
    for (auto& said : thing == nullptr ? std::vector{word} : words_of(thing))
      result.push_back(std::move(said));
  }
  return result;
}

TEST(LexiconExamples, MeanWhatTheGrammarUnderstands) {
  Parser parser{words_of_requests()->lexicon()};
  std::string last;
  for (const auto& [meaning, sentence] : sentences_of_lexicon())
    if (std::exchange(last, meaning) != meaning) {
      EXPECT_TRUE(parser.parse_whole(with_things(meaning))) << meaning;
    }
}

/// Every tenth sentence is compared with the others.
TEST(LexiconExamples, MostlyMeanWhatTheOthersTeach) {
  const auto all = sentences_of_lexicon();
  const auto is_asked = [](std::size_t i) { return i % 10 == 0; };
  Examples others;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!is_asked(i))
      others.add(all[i].first, all[i].second);
  std::size_t asked = 0;
  std::size_t found = 0;
  std::size_t right = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_asked(i))
      continue;
    std::vector<ExamplePiece> said;
    for (auto& word : words_of(all[i].second)) {
      const bool is_slot = word == "x" || word == "y" || word == "z";
      said.push_back({{std::move(word)}, is_slot});
    }
    const auto nearest = others.likeliest(said, 1);
    ++asked;
    found += nearest.empty() ? 0 : 1;
    right += !nearest.empty() && nearest.front().meaning == words_of(all[i].first) ? 1 : 0;
  }
  fmt::print(
    "of {} sentences {} mean what the others teach, {} are taken for another, {} for none\n", asked,
    right, found - right, asked - found);
  EXPECT_GT(right, asked * 8 / 10);
}

} // namespace

} // namespace castor::communication::test
