#include "castor/communication/parsing/spelling.hpp"

#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace castor::communication {

namespace {

/// The words of an utterance as they are understood.
std::vector<std::string> corrected(const std::string& said) {
  auto words = words_of(said);
  correct_spelling(words, *english_lexicon());
  return words;
}

} // namespace

using testing::ElementsAre;

TEST(Spelling, WordsALetterOffAreCorrected) {
  EXPECT_THAT(corrected("is teh bal blak"), ElementsAre("is", "the", "ball", "black"));
}

TEST(Spelling, AWordThatNothingIsLikeStaysAndOthersAreCorrected) {
  EXPECT_THAT(corrected("xyzzyq, wher is the bal"),
              ElementsAre("xyzzyq", ",", "where", "is", "the", "ball"));
}

TEST(Spelling, WhatIsSpeltRightlyIsNoOtherWord) {
  if (!is_english_word("port"))
    GTEST_SKIP() << "wamerican-small is not installed";
  EXPECT_THAT(corrected("clear the decks to port"),
              ElementsAre("clear", "the", "decks", "to", "port"));
  // Another form of a word, and what things are called by.
  EXPECT_THAT(corrected("it puts the cub there"), ElementsAre("it", "put", "the", "cube", "there"));
}

TEST(Spelling, LettersThatMakeAWordLongAreLeftOut) {
  EXPECT_THAT(corrected("hiiii, sooo coool"), ElementsAre("hi", ",", "so", "cool"));
  auto words = words_of("hiiii");
  EXPECT_TRUE(correct_spelling(words, *english_lexicon()).empty());
}

TEST(Spelling, NamesAreNotWhatIsMeant) {
  EXPECT_THAT(corrected("matel"), ElementsAre("matel"));
  EXPECT_THAT(corrected("Mia"), ElementsAre("mia"));
}

} // namespace castor::communication
