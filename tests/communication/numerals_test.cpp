#include "castor/communication/parsing/numerals.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gmock/gmock.h>

using castor::communication::is_numeral;
using castor::communication::metres_of_centimetres;
using castor::communication::words_of;
using testing::ElementsAre;

TEST(Numerals, AreDigitsWithOrWithoutDecimals) {
  EXPECT_TRUE(is_numeral("7"));
  EXPECT_TRUE(is_numeral("5.5"));
  EXPECT_FALSE(is_numeral("5cm"));
  EXPECT_FALSE(is_numeral("seven"));
  EXPECT_FALSE(is_numeral(".5"));
  EXPECT_FALSE(is_numeral("inf"));
  EXPECT_FALSE(is_numeral(""));
  EXPECT_DOUBLE_EQ(metres_of_centimetres("5.5"), 0.055);
  EXPECT_DOUBLE_EQ(metres_of_centimetres("some"), 0);
}

TEST(Numerals, OfLengthsAreInCentimetres) {
  EXPECT_THAT(words_of("about forty-five mm"), ElementsAre("4.5", "cm"));
  EXPECT_THAT(words_of("two and a half centimetres"), ElementsAre("2.5", "cm"));
  EXPECT_THAT(words_of("half a centimetre"), ElementsAre("0.5", "cm"));
  EXPECT_THAT(words_of("5.5cm"), ElementsAre("5.5", "cm"));
  EXPECT_THAT(words_of("two inches"), ElementsAre("5.08", "cm"));
  EXPECT_THAT(words_of("0.1 m"), ElementsAre("10", "cm"));
  EXPECT_THAT(words_of("exactly seven centimetres"), ElementsAre("7", "cm"));
  EXPECT_THAT(words_of("in centimetres"), ElementsAre("in", "centimetres"));
}

TEST(Numerals, OfThingsStayWordsUpToTwelve) {
  EXPECT_THAT(words_of("exactly two balls"), ElementsAre("exactly", "two", "balls"));
  EXPECT_THAT(words_of("about twenty-one balls"), ElementsAre("about", "21", "balls"));
  EXPECT_THAT(words_of("seventeen"), ElementsAre("17"));
  EXPECT_THAT(words_of("half a ball"), ElementsAre("half", "a", "ball"));
}

TEST(Numerals, EndWithTheirSentence) {
  EXPECT_THAT(words_of("Move it by 5."), ElementsAre("move", "it", "by", "5"));
  EXPECT_THAT(words_of("one, two"), ElementsAre("one", ",", "two"));
}
