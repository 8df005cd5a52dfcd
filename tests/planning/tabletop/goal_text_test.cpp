#include "castor/planning/tabletop/goal_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::planning {

TEST(PartsIn, AreThoseThatCanBeSeen) {
  EXPECT_THAT(parts_in("(and (in-part a left) (in-part b elsewhere) (left-of a b) (in-part c left)"
                       " (in-part d strip-1-of-2))"),
              testing::ElementsAre("left", "strip-1-of-2"));
}

TEST(ContainsWord, WholeWordsOnly) {
  EXPECT_TRUE(contains_word("(and (in-part ball left))", "ball"));
  EXPECT_TRUE(contains_word("ball", "ball"));
  EXPECT_FALSE(contains_word("(and (in-part ball-2 left))", "ball"));
  EXPECT_FALSE(contains_word("(and (in-part football left))", "ball"));
  EXPECT_TRUE(contains_word("(left-of ball-2 ball)", "ball"));
}

TEST(IsSubject, NotWhatAnotherIsPutAt) {
  constexpr auto goal = "(and (between ball box disc) (= (pos cup) place-1) (held can))";
  for (const auto* subject : {"ball", "cup", "can"})
    EXPECT_TRUE(is_subject(goal, subject)) << subject;
  for (const auto* other : {"box", "disc", "place-1", "bal", "between"})
    EXPECT_FALSE(is_subject(goal, other)) << other;
}

TEST(PartsIn, AreNoArrangementsAndNoPlacesOnThings) {
  EXPECT_THAT(
    parts_in("(and (in-part a left) (in-part a in-row) (in-part a apart) (in-part a on) (in-part a each-corner))"),
    testing::ElementsAre("left"));
}

TEST(WaypointWanted, IsThatOfTheThing) {
  constexpr auto goal = "(and (= (pos ball) place-1) (= (pos box) place-12) (near disc box))";
  EXPECT_EQ(waypoint_wanted(goal, "ball"), "place-1");
  EXPECT_EQ(waypoint_wanted(goal, "box"), "place-12");
  EXPECT_EQ(waypoint_wanted(goal, "disc"), "");
}

} // namespace castor::planning
