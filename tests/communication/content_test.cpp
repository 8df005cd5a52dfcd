#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/realiser.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"

#include <gtest/gtest.h>

using namespace castor::communication;

namespace {

std::string say(const LogicalForm& form) {
  static Realiser realiser(english_lexicon());
  return realiser.realise(form).value_or("nothing");
}

const LogicalForm red = property("colour", "red");

} // namespace

TEST(Content, AnswersQuestions) {
  EXPECT_EQ(say(marker("yes")), "Yes.");
  EXPECT_EQ(say(ascribe(pronoun("it"), property("colour", "blue"))), "It is blue.");
  EXPECT_EQ(say(ascribe(definite("square"), red)), "The square is red.");
  EXPECT_EQ(say(with_marker("no", ascribe(pronoun("it"), red))), "No, it is red.");
  EXPECT_EQ(say(with_marker("no", ascribe(pronoun("it"), red, false))), "No, it is not red.");
  EXPECT_EQ(say(ascribe(definite("box"), region("left", definite("ball")))),
            "The box is to the left of the ball.");
  EXPECT_EQ(say(ascribe(pronoun("it"), definite("ball"))), "It is the ball.");
}

TEST(Content, SaysWhatThereIs) {
  LogicalForm things{"t", {{"t", "thing", "thing", {{"Number", "pl"}}, {}}}, 0};
  things = with(with(things, "Quantity", property("number", "two")), "Colour", red);
  EXPECT_EQ(say(exists(things)), "There are two red things.");
}

TEST(Content, AsksBack) {
  EXPECT_EQ(say(which(definite("ball"))), "Which ball do you mean?");
  EXPECT_EQ(say(which(with(definite("ball"), "Colour", red))), "Which red ball do you mean?");
  EXPECT_EQ(say(unknown_word("zorg")), "I do not know the word 'zorg'.");
}
