#include "castor/communication/dialogue/self_correction.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <gtest/gtest.h>

#include <string>

using namespace castor::communication;

namespace {

/// Empty if nothing is corrected.
std::string corrected(const std::string& said) {
  std::string result;
  if (const auto words = self_corrected(words_of(said)))
    for (const auto& word : *words)
      result += (result.empty() ? "" : " ") + word;
  return result;
}

} // namespace

TEST(SelfCorrection, IsOfTheThingOfTheSameNoun) {
  EXPECT_EQ(corrected("Put the red cube behind the disc, no, I mean the green cube."),
            "put the green cube behind the disc");
  EXPECT_EQ(corrected("Put the disc behind the red cube, sorry, the green cube, please."),
            "put the disc behind the green cube , please");
}

TEST(SelfCorrection, IsElseOfTheLastThing) {
  EXPECT_EQ(corrected("Take the yellow disc, no, sorry, the ball, and put it at the left edge."),
            "take the ball , and put it at the left edge");
  EXPECT_EQ(corrected("Put the disc on the red cube, no, the blue one."),
            "put the disc on the blue one");
}

TEST(SelfCorrection, IsOfASide) {
  EXPECT_EQ(corrected("Put the cube on the left of the disc, no, sorry, on the right of it."),
            "put the cube on the right of the disc");
}

TEST(SelfCorrection, IsOfTheLastThingAndNotOfAPartOfTheTable) {
  EXPECT_EQ(corrected("Put the ball at the back, no sorry, the cube."), "put the cube at the back");
  EXPECT_EQ(corrected("Move the blue ball to the left edge, oh no, the red cube."),
            "move the red cube to the left edge");
}

TEST(SelfCorrection, IsOfAPlace) {
  EXPECT_EQ(corrected("Put the cube at the back, sorry, at the front."),
            "put the cube at the front");
  EXPECT_EQ(corrected("Put the cube next to the disc, no, behind the ball."),
            "put the cube behind the ball");
  EXPECT_EQ(corrected("Move the cube to the left edge, no, wait, in the middle of the table."),
            "move the cube in the middle of the table");
  EXPECT_EQ(corrected("Put the cube in front of the disc, no, behind it."), "");
}

TEST(SelfCorrection, IsNothingElse) {
  for (const auto* said :
       {"Put the cube on the disc, and the ball on the left.", "No, the red cube.",
        "Put the cube on the disc, no, wait.", "Sorry, I meant the ball.",
        "Is there no ball, the red one?", "Take the ball, then the cube."})
    EXPECT_EQ(corrected(said), "") << said;
}
