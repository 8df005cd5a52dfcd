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

TEST(Refusals, NameTheThingsThatHelpIfTheyAreTakenAway) {
  const Refusal by_seen_box{by_box.reason, by_box.in_way, {"o2"}};
  EXPECT_EQ(explanation_of({by_seen_box, too_far}).in_way_ids, std::vector<std::string>{"o2"});
  EXPECT_TRUE(explanation_of({by_seen_box, too_far, too_far}).in_way_ids.empty());
}

TEST(Refusals, OtherwiseTheMostFrequentReasonDoes) {
  EXPECT_EQ(explanation_of({slipped, too_far, by_box, too_far}),
            (Explanation{too_far.reason, "Tell me another place."}));
  EXPECT_EQ(explanation_of({slipped, too_far}), (Explanation{slipped.reason, {}}));
}

TEST(Refusals, SayWhatWouldHelp) {
  const auto help = [](const std::string& reason) { return explanation_of({{reason, {}}}).help; };
  EXPECT_EQ(help("I do not reach any such place with it"), "Tell me another place.");
  EXPECT_EQ(help("the ball is out of reach: it is 0.90 m away"), "Move it nearer to me.");
  EXPECT_EQ(help("the chest is too large or too flat for the gripper: it is 0.2 m"),
            "I may be able to push it.");
}

TEST(Refusals, OfAPlannerAreSaidInWordsThatPeopleUse) {
  const auto none = explanation_of_planning(
    "there is no plan: the goal cannot be reached, even if no action deletes anything");
  EXPECT_EQ(none.reason, "as things are now, nothing that I can do leads to that");
  EXPECT_EQ(none.help, "Tell me what to move before.");
  const auto late =
    explanation_of_planning("no plan was found within the limits, after 10000 states");
  EXPECT_EQ(late.reason, "I did not find out in time how to do it");
  EXPECT_EQ(late.help, "Ask me for one thing after the other.");
  EXPECT_EQ(explanation_of_planning("it fell"), (Explanation{"it fell", {}}));
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
