#include "castor/planning/tabletop/refusals.hpp"

#include <gtest/gtest.h>

namespace castor::planning {

namespace {

const Refusal too_far{"its place is out of reach", {}};
const Refusal by_box{"the box is in the arm's way at its place", {"the box"}};
const Refusal by_both{"the box and the can are in the arm's way", {"the box", "the can"}};
const Refusal slipped{"it slipped out of the gripper", {}};

} // namespace

TEST(Refusals, WhatIsInTheWayMostOftenExplains) {
  const Explanation expected{by_box.reason, "Take the box away first."};
  EXPECT_EQ(explanation_of({by_box, too_far}), expected);
  EXPECT_EQ(explanation_of({too_far, by_both, by_box}), expected);
  EXPECT_EQ(explanation_of({by_both, too_far}),
            (Explanation{by_both.reason, "Take the box and the can away first."}));
}

TEST(Refusals, OtherwiseTheMostFrequentReasonDoes) {
  EXPECT_EQ(explanation_of({slipped, too_far, by_box, too_far}), (Explanation{too_far.reason, {}}));
  EXPECT_EQ(explanation_of({slipped, too_far}), (Explanation{slipped.reason, {}}));
}

TEST(Refusals, NothingExplainsNothing) {
  EXPECT_EQ(explanation_of({}), Explanation{});
}

TEST(Refusals, NameTheJointsThatDoNotMove) {
  EXPECT_EQ(with_joints("its place is out of reach", {"lift"}),
            "its place is out of reach; the arm's joint lift does not move any more");
  EXPECT_EQ(with_joints("it is too far; its joint lift does not move any more", {"lift"}),
            "it is too far; its joint lift does not move any more");
  EXPECT_EQ(with_joints("it is too far", {}), "it is too far");
}

TEST(Refusals, AreSaidInWordsThatPeopleUse) {
  const std::map<std::string, std::string> words{{"sphere", "ball"}};
  EXPECT_EQ(with_words("the red sphere, 0.06 m: spheres", words), "the red ball, 0.06 m: spheres");
  EXPECT_EQ(with_words("sphere", words), "ball");
  EXPECT_EQ(with_words("", words), "");
}

} // namespace castor::planning
