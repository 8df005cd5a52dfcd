#include "castor/communication/parsing/tokens.hpp"

#include <gmock/gmock.h>

using castor::communication::sentences_of;
using castor::communication::words_of;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(Words, AreInLowerCaseAndPunctuatedByPausesOnly) {
  EXPECT_THAT(words_of("Put the cup,  near the BOX!"),
              ElementsAre("put", "the", "cup", ",", "near", "the", "box"));
  EXPECT_THAT(words_of(" ... ?! "), IsEmpty());
}

TEST(Words, AreSplitWhereTwoAreWrittenAsOne) {
  EXPECT_THAT(words_of("What's it? Don't. It isn't; I cannot, can't."),
              ElementsAre("what", "'s", "it", "do", "n't", "it", "is", "n't", ",", "i", "can",
                          "not", ",", "can", "n't"));
}

TEST(Words, MayLackTheirApostrophe) {
  EXPECT_THAT(words_of("theres a ball isnt it"),
              ElementsAre("there", "'s", "a", "ball", "is", "n't", "it"));
}

TEST(Words, InQuotesStayTogether) {
  EXPECT_THAT(words_of("the word 'zorg' and \"Big Ben\"."),
              ElementsAre("the", "word", "'zorg'", "and", "'Big Ben'"));
}

TEST(Words, OfAContractionBeginNoQuotation) {
  EXPECT_THAT(words_of("what 's the word 'zorg'"),
              ElementsAre("what", "'s", "the", "word", "'zorg'"));
}

TEST(Words, SurviveStrayQuotesAndForeignLetters) {
  EXPECT_THAT(words_of("' the '' b\xc3\xa4ll '"), ElementsAre("the", "b\xc3\xa4ll"));
}

TEST(Sentences, DoNotEndAfterTitles) {
  EXPECT_THAT(sentences_of("The ball is for Mrs. Jones. Where is it?"),
              ElementsAre("The ball is for Mrs. Jones.", "Where is it?"));
}

TEST(Sentences, EndWithTheirMarks) {
  EXPECT_THAT(sentences_of("There is a ball. What size is it?  Put it on 3.5!\nOk"),
              ElementsAre("There is a ball.", "What size is it?", "Put it on 3.5!", "Ok"));
  EXPECT_THAT(sentences_of(" . ?"), IsEmpty());
  EXPECT_THAT(sentences_of(""), IsEmpty());
}
