// Requests that are not understood as they are said, but whose things and places are.
#include "castor/communication/dialogue/request_gist.hpp"

#include "castor/communication/parsing/tokens.hpp"
#include "castor/tests/communication/directive_sentences.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::communication::test {

namespace {

/// What is proposed; "-" if nothing is.
std::string gist_of(const std::string& said) {
  Parser parser{words_of_requests()->lexicon()};
  const auto form = request_gist(parser, words_of(said));
  return form ? form->partial.value().words : "-";
}

} // namespace

TEST(RequestGist, LeavesOutWordsThatSayNothingOfAThingOrAPlace) {
  EXPECT_EQ(gist_of("Would you mind zorging the blue ball just left of the purple ball?"),
            "put the blue ball just left of the purple ball");
  EXPECT_EQ(gist_of("Let the little green one loiter between the cylinder and the red cube."),
            "put the little green one between the cylinder and the red cube");
  EXPECT_EQ(gist_of("Zorg that red cube over to the right side for me."),
            "put that red cube over to the right side for me");
  EXPECT_EQ(gist_of("Zorg the red cube next to the blue ball real quick."),
            "put the red cube next to the blue ball");
}

TEST(RequestGist, TakesPlacesThatAreSaidFirst) {
  EXPECT_EQ(gist_of("To the left of the blue ball, place the small cube."),
            "put the small cube to the left of the blue ball");
}

TEST(RequestGist, LeavesOutWhyItIsAskedFor) {
  EXPECT_EQ(gist_of("Zorg the red cube along the back edge because nobody needs two of it."),
            "put the red cube along the back edge");
}

TEST(RequestGist, LeavesNothingOutThatMayMatter) {
  EXPECT_EQ(gist_of("Zorg the red cube to the left but gently."), "-");
  EXPECT_EQ(gist_of("Do not zorg the red cube to the left."), "-");
  EXPECT_EQ(gist_of("Zorg the red cube to the left if it fits."), "-");
  EXPECT_EQ(gist_of("Zorg the red cube."), "-");
  EXPECT_EQ(gist_of("Where did the red cube zorg to the left?"), "-");
  EXPECT_EQ(gist_of("Zorg the red cube to the left 7 blorps."), "-");
}

} // namespace castor::communication::test
