#include "castor/planning/motivation/table_goals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::planning {

namespace {

using communication::DirectiveStep;
using testing::HasSubstr;

const std::vector<TableThing> table{
  {"p/a", "a", "at-a", "the red ball", -0.2, {{"colour", "red"}, {"shape", "sphere"}}, {"left"}},
  {"p/b", "b", "at-b", "the blue ball", 0.1, {{"colour", "blue"}, {"shape", "sphere"}}, {"right"}},
  {"p/c",
   "c",
   "at-c",
   "the red box",
   -0.1,
   {{"colour", "red"}, {"shape", "cube"}},
   {"left"},
   "at-old"}};

std::string formula(const DirectiveStep& step) {
  const auto goal = goal_of(step, table);
  EXPECT_EQ(goal.wish, TableWish::goal) << goal.words;
  return goal.formula;
}

std::string refused(const DirectiveStep& step, const std::vector<TableThing>& things = table) {
  const auto goal = goal_of(step, things);
  EXPECT_EQ(goal.wish, TableWish::refusal) << goal.formula;
  return goal.words;
}

} // namespace

TEST(TableGoals, ToPutIsToBeThere) {
  EXPECT_EQ(formula({"Put", {"p/b"}, 0, {{"right", {"p/c"}}}, {}}), "(and (right-of b c))");
  EXPECT_EQ(formula({"Put", {"p/a", "p/b"}, 0, {{"left", {"p/c"}}}, {}}),
            "(and (left-of a c) (left-of b c))");
  EXPECT_EQ(formula({"Put", {"p/b"}, 0, {{"between", {"p/a", "p/c"}}}, {}}),
            "(and (between b a c))");
  EXPECT_EQ(formula({"Put", {"p/a", "p/b"}, 1, {{"on", {"p/c"}}}, {}}), "(and (on a c))");
  const auto goal = goal_of({"Put", {"p/b"}, 0, {{"left-edge", {}}}, {}}, table);
  EXPECT_EQ(goal.formula, "(and (in-part b left-edge))");
  EXPECT_EQ(goal.parts, (std::vector<std::string>{"left-edge"}));
  EXPECT_EQ(goal.words, "put the blue ball at the left edge");
  EXPECT_EQ(goal.result, "The blue ball is at the left edge now.");
  EXPECT_EQ(goal_of({"Put", {"p/a", "p/b"}, 0, {{"right", {"p/c"}}}, {}}, table).result,
            "The red ball and the blue ball are to the right of the red box now.");
}

TEST(TableGoals, ASideAndTheMiddleAreTheMiddleOfThatSide) {
  for (const auto& places :
       {std::vector<communication::DirectivePlace>{{"front", {}}, {"centre", {}}},
        {{"centre", {}}, {"front", {}}}}) {
    const auto goal = goal_of({"Put", {"p/b"}, 0, places, {}}, table);
    EXPECT_EQ(goal.formula, "(and (in-part b front-middle))");
    EXPECT_EQ(goal.words, "put the blue ball at the front in the middle");
  }
  EXPECT_EQ(formula({"Put", {"p/b"}, 0, {{"left-edge", {}}, {"centre", {}}}, {}}),
            "(and (in-part b left-edge-middle))");
  // Between others it is not.
  EXPECT_EQ(formula({"Put", {"p/b"}, 0, {{"centre", {}}, {"left", {"p/a"}}}, {}}),
            "(and (in-part b centre) (left-of b a))");
}

TEST(TableGoals, ACornerThatIsNotReachedIsAQuarterOfTheTable) {
  const auto in_front = [](const TableThing&, double, double y) {
    return y < 0.1 ? spatial::Reach::direct : spatial::Reach::none;
  };
  const DirectiveStep back{"Put", {"p/b"}, 0, {{"back-right-corner", {}}}, {}};
  const auto goal = goal_of(back, table, in_front);
  EXPECT_EQ(goal.formula, "(and (in-part b back-right))");
  EXPECT_EQ(goal.words, "put the blue ball as near to the back right corner as I reach with it");
  EXPECT_EQ(goal.result,
            "The blue ball is as near to the back right corner as I reach with it now.");
  EXPECT_EQ(goal_of(back, table).formula, "(and (in-part b back-right-corner))");
  const DirectiveStep front{"Put", {"p/b"}, 0, {{"front-right-corner", {}}}, {}};
  EXPECT_EQ(goal_of(front, table, in_front).formula, "(and (in-part b front-right-corner))");
  auto there = table;
  for (auto& x : there)
    if (x.object == "b") {
      x.x = 0.1;
      x.y = 0.08;
    }
  EXPECT_EQ(goal_of(back, there, in_front).words,
            "The corner is out of reach with the blue ball, which is at the back right already.");
}

/// An arm that can put things up to there.
TableLanding landing_up_to(double farthest) {
  return [farthest](const TableThing&, const std::vector<spatial::GroundPoint>& points, bool) {
    std::vector<spatial::Reach> result;
    for (const auto& at : points)
      result.push_back(at.y < farthest ? spatial::Reach::direct : spatial::Reach::none);
    return result;
  };
}

/// The reach says where things can be put at all, the arm itself where it can put this one.
TEST(TableGoals, WhatTheArmCannotPutInTheMiddleOfAnEdgeIsPutAsNearAsItCan) {
  const DirectiveStep back{"Put", {"p/b"}, 0, {{"back-edge", {}}, {"centre", {}}}, {}};
  const auto goal = goal_of(back, table, reach_in_box, {}, landing_up_to(0.13));
  EXPECT_EQ(goal.words,
            "put the blue ball as near to the middle of the back edge as I reach with it");
  EXPECT_EQ(goal.formula, "(and (= (pos b) spot-of-b))");
  ASSERT_EQ(goal.spots.size(), 1U);
  EXPECT_LT(goal.spots.front().y, 0.13);
  EXPECT_GT(goal.spots.front().y, 0.09);
  EXPECT_NEAR(goal.spots.front().x, 0, 0.04);
  EXPECT_EQ(goal_of(back, table, reach_in_box, {}, landing_up_to(1)).formula,
            "(and (in-part b back-edge-middle))");
}

TEST(TableGoals, WhatIsPutAtAnEdgeStandsWhereTheArmCanPutIt) {
  const DirectiveStep back{"Put", {"p/b"}, 0, {{"back-edge", {}}}, {}};
  const auto there = goal_of(back, table, reach_in_box, {}, landing_up_to(1));
  EXPECT_EQ(there.words, "put the blue ball at the back edge");
  EXPECT_EQ(there.formula, "(and (= (pos b) spot-of-b))");
  ASSERT_EQ(there.spots.size(), 1U);
  EXPECT_GT(there.spots.front().y, 0.2);
  const auto near = goal_of(back, table, reach_in_box, {}, landing_up_to(0.13));
  EXPECT_EQ(near.words, "put the blue ball as near to the back edge as I reach with it");
  ASSERT_EQ(near.spots.size(), 1U);
  EXPECT_LT(near.spots.front().y, 0.13);
  EXPECT_GT(near.spots.front().y, 0.09);
  // What nobody says to be possible is left to who plans it.
  EXPECT_EQ(goal_of(back, table, reach_in_box, {}, landing_up_to(-1)).formula,
            "(and (in-part b back-edge))");
}

TEST(TableGoals, WhatStandsOnAnotherIsBesideNothing) {
  auto stacked = table;
  for (auto& x : stacked)
    if (x.object == "a")
      x.on = "c";
  EXPECT_EQ(goal_of({"Put", {"p/b"}, 0, {{"left", {"p/a", "p/c"}}}, {}}, stacked).formula,
            "(and (left-of b c))");
}

TEST(TableGoals, WhatIsSwappedHasToFitWhereTheOtherIs) {
  const auto not_there = [](const TableThing& x, const TableThing&) -> std::optional<std::string> {
    return x.object == "b" ? "the gripper is too wide for it there" : "";
  };
  EXPECT_EQ(goal_of({"Swap", {"p/a", "p/b"}, 0, {}, {}}, table, reach_in_box, not_there).words,
            "I cannot put the blue ball where the red ball is: the gripper is too wide for it "
            "there.");
  EXPECT_EQ(goal_of({"Swap", {"p/a", "p/c"}, 0, {}, {}}, table, reach_in_box, not_there).wish,
            TableWish::goal);
}

TEST(TableGoals, WhatDoesNotFitWhereTheOtherIsFitsBesideOrNothingIsMoved) {
  const auto not_there = [](const TableThing& x, const TableThing&) -> std::optional<std::string> {
    return x.object == "b" ? "the gripper is too wide for it there" : "";
  };
  const DirectiveStep swap{"Swap", {"p/a", "p/b"}, 0, {}, {}};
  const auto landing = [](double farthest) -> TableLanding {
    return [farthest](const TableThing&, const auto& points, bool) {
      std::vector<spatial::Reach> result;
      for (const auto& x : points)
        result.push_back(x.y < farthest ? spatial::Reach::direct : spatial::Reach::none);
      return result;
    };
  };
  const auto goal = goal_of(swap, table, reach_in_box, not_there, landing(table[0].y - 0.01));
  EXPECT_EQ(goal.formula, "(and (= (pos a) at-b) (= (pos b) spot-of-b))") << goal.words;
  ASSERT_EQ(goal.spots.size(), 1U);
  EXPECT_LT(std::hypot(goal.spots[0].x - table[0].x, goal.spots[0].y - table[0].y), 0.026);
  EXPECT_EQ(goal_of(swap, table, reach_in_box, not_there, landing(-1)).words,
            "I cannot put the blue ball where the red ball is: the gripper is too wide for it "
            "there.");
}

TEST(TableGoals, ARowThatTheArmCannotPutIsRefusedWithTheReason) {
  const TableLanding landing = [](const TableThing& x, const auto&, bool) {
    return std::vector{x.object == "b" ? spatial::Reach::none : spatial::Reach::direct};
  };
  // None stands where it is to be.
  auto at_back = table;
  for (auto& x : at_back)
    x.y = 0.1;
  const DirectiveStep row{"Put", {"p/b", "p/a"}, 0, {{"in-row", {}}, {"front", {}}}, {}};
  const auto goal = goal_of(row, at_back, reach_in_box, {}, landing);
  EXPECT_EQ(goal.wish, TableWish::refusal);
  EXPECT_THAT(goal.words, HasSubstr("I do not reach any such place with the blue ball"));
}

TEST(TableGoals, SortingPutsThingsOfAValueTogether) {
  // They stand so already.
  EXPECT_EQ(formula({"Sort", {"p/a", "p/b", "p/c"}, 0, {}, "colour"}),
            "(and (= (pos a) at-a) (= (pos c) at-c) (= (pos b) at-b))");
  EXPECT_EQ(formula({"Sort", {"p/a", "p/b", "p/c"}, 0, {}, "shape"}),
            "(and (= (pos c) at-c) (= (pos a) spot-of-a) (= (pos b) at-b))");
  // Where there is no room for that, each value has a strip of the table.
  const auto nowhere = [](const TableThing&, double, double) { return spatial::Reach::none; };
  EXPECT_EQ(goal_of({"Sort", {"p/a", "p/b", "p/c"}, 0, {}, "shape"}, table, nowhere).formula,
            "(and (in-part c strip-1-of-2) (in-part a strip-2-of-2) (in-part b strip-2-of-2))");
  EXPECT_EQ(refused({"Sort", {"p/a", "p/c"}, 0, {}, "colour"}), "They are all of the same colour.");
  EXPECT_EQ(refused({"Sort", {"p/a", "p/c"}, 0, {}, "size"}),
            "I do not know the size of the red ball.");
}

TEST(TableGoals, ClearingMovesAllToTheOtherSide) {
  EXPECT_EQ(formula({"Clear", {}, 0, {{"left", {}}}, {}}),
            "(and (in-part a right) (in-part c right))");
  EXPECT_EQ(refused({"Clear", {}, 0, {{"front", {}}}, {}}), "There is nothing at the front.");
  EXPECT_EQ(
    refused({"Clear", {}, 0, {{"table", {}}}, {}}),
    "I have nowhere else to put the things. I can sort them by colour or shape, put them in a "
    "row, or clear one side.");
}

TEST(TableGoals, SwappedThingsAreWhereTheOtherWas) {
  EXPECT_EQ(formula({"Swap", {"p/a", "p/b"}, 0, {}, {}}),
            "(and (= (pos a) at-b) (= (pos b) at-a))");
}

/// Nothing is moved, rather than one of them in vain.
TEST(TableGoals, WhatIsOutOfReachIsSaidBeforeAnythingIsMoved) {
  const auto reach = [](const TableThing& x, double at, double) {
    return x.object == "b" && at < 0 ? spatial::Reach::none : spatial::Reach::direct;
  };
  for (const auto& both : {std::vector<std::string>{"p/a", "p/b"}, {"p/b", "p/a"}}) {
    const auto goal = goal_of({"Swap", both, 0, {}, {}}, table, reach);
    EXPECT_EQ(goal.wish, TableWish::refusal);
    EXPECT_EQ(goal.words, "I cannot put the blue ball where the red ball is: I do not reach there "
                          "with it.");
  }
  EXPECT_EQ(goal_of({"Swap", {"p/a", "p/c"}, 0, {}, {}}, table, reach).wish, TableWish::goal);
  EXPECT_EQ(goal_of({"Put", {"p/b"}, 0, {{"where", {"p/c"}}}, {}}, table, reach).words,
            "I cannot put the blue ball where the red box is: I do not reach there with it.");
  EXPECT_EQ(goal_of({"Put", {"p/b"}, 0, {{"further-left", {}, 0.15}}, {}}, table, reach).words,
            "I do not reach there with the blue ball.");
}

TEST(TableGoals, BackIsWhereItWasBefore) {
  EXPECT_EQ(formula({"PutBack", {"p/c"}, 0, {}, {}}), "(and (= (pos c) at-old))");
  EXPECT_EQ(refused({"PutBack", {"p/a"}, 0, {}, {}}),
            "I have not moved the red ball: it is where I saw it first.");
  EXPECT_EQ(formula({"PutBack", {"p/a", "p/c"}, 1, {}, {}}), "(and (= (pos c) at-old))");
  EXPECT_EQ(refused({"PutBack", {"p/a", "p/b"}, 1, {}, {}}), "There is nothing to put back.");
}

/// "No, the green one. - And the red one goes back where it was."
TEST(TableGoals, WhatIsBackStaysThereWhenItIsToBePutBackAgain) {
  auto things = table;
  things[2].has_returned = true;
  const auto goal = goal_of({"PutBack", {"p/c"}, 0, {}, {}}, things);
  EXPECT_EQ(goal.formula, "(and (= (pos c) " + things[2].waypoint + "))");
  EXPECT_TRUE(goal.is_return);
  EXPECT_FALSE(goal_of({"Take", {"p/c"}, 0, {}, {}}, things).is_return);
}

TEST(TableGoals, OfSeveralThoseThatWereMovedArePutBack) {
  EXPECT_EQ(formula({"PutBack", {"p/a", "p/b", "p/c"}, 0, {}, {}}), "(and (= (pos c) at-old))");
}

TEST(TableGoals, ItsOldPlaceIsThatOfTheThingIfItHasOne) {
  // "Put the box in its old place", after the ball was spoken of.
  EXPECT_EQ(formula({"PutBack", {"p/c"}, 0, {{"where-before", {"p/b"}}}, {}}),
            "(and (= (pos c) at-old))");
  EXPECT_EQ(formula({"PutBack", {"p/b"}, 0, {{"where-before", {"p/c"}}}, {}}),
            "(and (= (pos b) at-old))");
  EXPECT_EQ(refused({"PutBack", {"p/b"}, 0, {{"where-before", {"p/a"}}}, {}}),
            "I have not moved the blue ball: it is where I saw it first.");
}

TEST(TableGoals, EverythingGoesBackToWhereItWasAtFirst) {
  auto things = table;
  things[0].waypoint_before = "a-2";
  things[0].waypoint_at_first = "a-1";
  things[2].waypoint_at_first = "at-c";
  const auto goal = goal_of({"Restore", {}, 0, {}, {}}, things);
  // The box is where it was at first, and the blue ball was never moved.
  EXPECT_EQ(goal.formula, "(and (= (pos a) a-1))");
  EXPECT_EQ(goal.words, "put the red ball back where it was at first");
  EXPECT_EQ(goal.result, "The red ball is where it was at first.");
  EXPECT_EQ(goal_of({"Restore", {"p/a", "p/b"}, 0, {}, {}}, things).formula,
            "(and (= (pos a) a-1))");
  EXPECT_EQ(refused({"Restore", {"p/b"}, 0, {}, {}}, things),
            "I have moved nothing that is not where it was at first.");
}

TEST(TableGoals, AreAboutTheThingsThatWereChosen) {
  EXPECT_EQ(goal_of({"Take", {"p/a", "p/b"}, 1, {}, {}}, table).things,
            std::vector<std::string>{"p/a"});
  auto holding = table;
  holding[1].is_held = true;
  EXPECT_EQ(goal_of({"Take", {"p/a", "p/b"}, 1, {}, {}}, holding).things,
            std::vector<std::string>{"p/b"});
}

TEST(TableGoals, WhereAThingWasIsSaidByOthers) {
  auto things = table;
  things[2].spot_before = {"at-old", -0.05, 0};
  const auto answer = goal_of({"WhereWas", {"p/c"}, 0, {}, {}}, things);
  EXPECT_EQ(answer.wish, TableWish::answer);
  // 15 cm from either ball; the first one is nearest of equals.
  EXPECT_EQ(answer.words, "The red box was to the right of where the red ball is now.");
  things[2].spot_before = {"at-old", 0.1, 0.12};
  EXPECT_EQ(goal_of({"WhereWas", {"p/c"}, 0, {}, {}}, things).words,
            "The red box was behind where the blue ball is now.");
  things[2].spot_before = {"at-old", 0.09, 0};
  EXPECT_EQ(goal_of({"WhereWas", {"p/c"}, 0, {}, {}}, things).words,
            "The red box was where the blue ball is now.");
  things[2].spot_before = {"at-old", -0.1, -0.4};
  EXPECT_EQ(goal_of({"WhereWas", {"p/c"}, 0, {}, {}}, things).words,
            "The red box was at the front.");
  EXPECT_EQ(goal_of({"WhereWas", {"p/a"}, 0, {}, {}}, things).words,
            "I have not moved the red ball.");
}

TEST(TableGoals, WhatIsHeldIsPutDown) {
  EXPECT_EQ(refused({"PutDown", {}, 0, {}, {}}), "I do not hold anything.");
  // That is no reason to leave out what else was asked for.
  const auto not_held = goal_of({"PutDown", {"p/a"}, 0, {}, {}}, table);
  EXPECT_EQ(not_held.wish, TableWish::answer);
  EXPECT_EQ(not_held.words, "I do not hold the red ball.");
  auto holding = table;
  holding.front().is_held = true;
  EXPECT_EQ(goal_of({"PutDown", {}, 0, {}, {}}, holding).formula, "(and (in-part a table))");
  EXPECT_EQ(goal_of({"Give", {}, 0, {}, {}}, holding).formula, "(and (in-part a at-hand))");
}

TEST(TableGoals, WhatIsDoneBeforeTakingIsSaid) {
  auto things = table;
  things[0].is_held = true;
  EXPECT_EQ(goal_of({"Take", {"p/b"}, 0, {}, {}}, things).words,
            "put down the red ball and take the blue ball");
  things = table;
  things[0].on = "c";
  EXPECT_EQ(goal_of({"Take", {"p/c"}, 0, {}, {}}, things).words,
            "take the red ball off the red box and take the red box");
  EXPECT_EQ(goal_of({"Push", {"p/c"}, 0, {}, {}}, things).words,
            "take the red ball off the red box and push the red box");
  EXPECT_EQ(goal_of({"Put", {"p/c"}, 0, {{"left", {}}}, {}}, things).words,
            "take the red ball off the red box and put the red box on the left");
  EXPECT_EQ(goal_of({"Put", {"p/c", "p/a"}, 0, {{"left", {}}}, {}}, things).words,
            "put the red box and the red ball on the left");
}

TEST(TableGoals, OnBothOfAStackIsOnTheUpperOne) {
  auto things = table;
  things[2].on = "a";
  EXPECT_EQ(goal_of({"Put", {"p/b"}, 0, {{"on", {"p/a", "p/c"}}}, {}}, things).formula,
            "(and (on b c))");
  EXPECT_EQ(refused({"Put", {"p/b"}, 0, {{"on", {"p/a", "p/c"}}}, {}}),
            "It can stand on one thing only.");
}

TEST(TableGoals, InTheMiddleIsBesideWhatIsThere) {
  auto things = table;
  things[2].x = 0.01;
  const auto goal = goal_of({"Put", {"p/b"}, 0, {{"centre", {}}}, {}}, things);
  EXPECT_EQ(goal.words,
            "put the blue ball as near to the middle as there is room beside the red box");
  EXPECT_EQ(goal_of({"Put", {"p/b"}, 0, {{"centre", {}}}, {}}, table).words,
            "put the blue ball in the middle");
}

TEST(TableGoals, OneOfEachColourStandsInARow) {
  auto things = table;
  things[2].qualities["colour"] = "green";
  const auto goal = goal_of({"Sort", {"p/a", "p/b", "p/c"}, 0, {}, "colour"}, things);
  EXPECT_EQ(goal.words, "sort the things by colour: each has a colour of its own");
  EXPECT_THAT(goal.result, HasSubstr("are in a row now: each has a colour of its own."));
}

TEST(TableGoals, BackIsWhereItWasBeforeTheGoalThatMovedItTwice) {
  auto things = table;
  things[2].waypoint_before = "on-its-way";
  things[2].waypoint_before_goal = "at-old";
  EXPECT_EQ(goal_of({"PutBack", {"p/c"}, 0, {}, {}}, things).formula, "(and (= (pos c) at-old))");
}

TEST(TableGoals, WhatCannotBeIsSaidWithTheReason) {
  EXPECT_EQ(refused({"Put", {"p/a"}, 0, {{"on", {"p/a"}}}, {}}),
            "I cannot put the red ball on itself.");
  EXPECT_EQ(refused({"Put", {"p/a", "p/b"}, 0, {{"on", {"p/c"}}}, {}}),
            "There is room for one thing only.");
  EXPECT_EQ(refused({"Put", {"p/c"}, 0, {{"on", {"p/b"}}}, {}}),
            "The blue ball is round: nothing stays on it. I can put the red box next to it.");
  EXPECT_EQ(refused({"Put", {"p/a"}, 0, {{"on", {"p/b"}}}, {}}),
            "The blue ball is round: nothing stays on it. I can put the red ball next to it, or on "
            "the red box.");
  EXPECT_EQ(refused({"Put", {"p/c"}, 0, {{"there", {}}}, {}}),
            "I do not know where that is: tell me a part of the table, or a thing that is there.");
  EXPECT_EQ(refused({"Put", {"p/a"}, 0, {{"under", {"p/c"}}}, {}}),
            "I cannot put things under others.");
  EXPECT_EQ(refused({"Take", {"p/a", "p/b"}, 0, {}, {}}), "I can hold one thing only.");
  EXPECT_EQ(refused({"Take", {"p/gone"}, 0, {}, {}}), "I do not see all of that any more.");
}

TEST(TableGoals, ManagingIsNoGoal) {
  EXPECT_EQ(goal_of({"Stop", {}, 0, {}, {}}, table).wish, TableWish::stop);
  EXPECT_EQ(goal_of({"Wait", {}, 0, {}, {}}, table).wish, TableWish::wait);
  EXPECT_EQ(goal_of({"GoOn", {}, 0, {}, {}}, table).wish, TableWish::go_on);
}

TEST(TableGoals, FailuresAreExplained) {
  EXPECT_EQ(explained("reach the ball", "the box is in the way"),
            "I cannot reach the ball: the box is in the way.");
  EXPECT_EQ(explained("do that", ""), "I cannot do that.");
}

TEST(TableGoals, WhereAnotherThingIsThatHasToLeave) {
  const auto goal = goal_of({"Put", {"p/a"}, 0, {{"where", {"p/b"}}}, {}}, table);
  EXPECT_EQ(goal.formula, "(and (= (pos a) at-b))");
  EXPECT_EQ(goal.words, "put the red ball where the blue ball is");
  EXPECT_EQ(goal.result, "The red ball is where the blue ball was.");
  // One place for the other thing, and one to spare.
  EXPECT_EQ(goal.new_places, 2U);
}

TEST(TableGoals, WhereAnotherThingWas) {
  EXPECT_EQ(formula({"Put", {"p/a"}, 0, {{"where-before", {"p/c"}}}, {}}),
            "(and (= (pos a) at-old))");
  EXPECT_EQ(refused({"Put", {"p/a"}, 0, {{"where-before", {"p/b"}}}, {}}),
            "I do not know where the blue ball was before.");
  EXPECT_EQ(refused({"Put", {"p/a", "p/b"}, 0, {{"where", {"p/c"}}}, {}}),
            "There is room for one thing only.");
}

TEST(TableGoals, FurtherToASideIsFromWhereItIs) {
  const auto goal = goal_of({"Put", {"p/b"}, 0, {{"further-left", {}}}, {}}, table);
  EXPECT_EQ(goal.formula, "(and (= (pos b) spot-of-b))");
  EXPECT_EQ(goal.words, "put the blue ball further left");
  ASSERT_EQ(goal.spots.size(), 1U);
  EXPECT_EQ(goal.spots.front().name, "spot-of-b");
  EXPECT_NEAR(goal.spots.front().x, 0.02, 1e-9);
  EXPECT_NEAR(goal.spots.front().y, 0, 1e-9);
  // The red box is 8 cm further left than that.
  auto things = table;
  things[1].x = -0.03;
  EXPECT_EQ(refused({"Put", {"p/b"}, 0, {{"further-left", {}}}, {}}, things),
            "The red box is in the way there. Take it away first.");
}

TEST(TableGoals, UndoingIsToPutBackAllThatTheLastGoalMoved) {
  auto things = table;
  things[0].waypoint_before_goal = "old-a";
  things[1].waypoint_before_goal = "old-b";
  const auto goal = goal_of({"Undo", {}, 0, {}, {}}, things);
  EXPECT_EQ(goal.formula, "(and (= (pos a) old-a) (= (pos b) old-b))");
  EXPECT_EQ(goal.result, "The red ball and the blue ball are where they were before.");
  EXPECT_EQ(refused({"Undo", {}, 0, {}, {}}), "There is nothing to undo.");
}

TEST(TableGoals, AThingCanBeReferredToByAProxyThatItHadBefore) {
  auto things = table;
  things[0].former_proxies = {"p/older", "p/old"};
  EXPECT_EQ(goal_of({"Take", {"p/old"}, 0, {}, {}}, things).words, "take the red ball");
  EXPECT_EQ(refused({"Take", {"p/other"}, 0, {}, {}}, things),
            "I do not see all of that any more.");
}

TEST(TableGoals, WhatIsNotToBeTouchedIsLeftOut) {
  auto things = table;
  things[0].is_kept = true;
  EXPECT_EQ(refused({"Take", {"p/a"}, 0, {}, {}}, things),
            "I am not to touch the red ball. Tell me that I may touch it again.");
  const auto both = goal_of({"Put", {"p/a", "p/b"}, 0, {{"left", {}}}, {}}, things);
  EXPECT_EQ(both.formula, "(and (in-part b left))");
  EXPECT_EQ(both.words, "put the blue ball on the left, but not the red ball");
  // "One of the balls" is the other one.
  EXPECT_EQ(goal_of({"Take", {"p/a", "p/b"}, 1, {}, {}}, things).formula, "(and (held b))");
  EXPECT_EQ(goal_of({"Clear", {}, 0, {{"left", {}}}, {}}, things).formula,
            "(and (in-part c right))");
  EXPECT_EQ(refused({"Swap", {"p/a", "p/b"}, 0, {}, {}}, things),
            "I am not to touch the red ball. Tell me that I may touch it again.");
  EXPECT_EQ(refused({"Put", {"p/b"}, 0, {{"where", {"p/a"}}}, {}}, things),
            "I am not to touch the red ball.");
  // What is held already can be put down.
  things[0].is_held = true;
  EXPECT_EQ(goal_of({"PutDown", {}, 0, {}, {}}, things).wish, TableWish::goal);
}

TEST(TableGoals, NothingIsPutOnWhatIsToBeKeptClear) {
  auto things = table;
  things[2].is_kept_clear = true;
  EXPECT_EQ(refused({"Put", {"p/a"}, 0, {{"on", {"p/c"}}}, {}}, things),
            "I am to put nothing on the red box. Tell me that I may touch it again.");
  EXPECT_EQ(goal_of({"Take", {"p/c"}, 0, {}, {}}, things).wish, TableWish::goal);
}

TEST(TableGoals, ProhibitionsAreNoGoals) {
  const auto keep = goal_of({"Forbid", {"p/a", "p/b"}, 0, {}, {}}, table);
  EXPECT_EQ(keep.wish, TableWish::keep);
  EXPECT_EQ(keep.words, "I will not touch the red ball and the blue ball.");
  EXPECT_EQ(keep.things, (std::vector<std::string>{"p/a", "p/b"}));
  const auto clear = goal_of({"Forbid", {"p/c"}, 0, {{"on", {}}}, {}}, table);
  EXPECT_EQ(clear.wish, TableWish::keep_clear);
  EXPECT_EQ(clear.words, "I will put nothing on the red box.");
  EXPECT_EQ(refused({"Allow", {"p/a"}, 0, {}, {}}),
            "I was not told to keep away from the red ball.");
  auto things = table;
  things[0].is_kept = true;
  EXPECT_EQ(goal_of({"Allow", {"p/a"}, 0, {}, {}}, things).wish, TableWish::allow);
}

TEST(TableGoals, SeveralWaysAreGoneAtOnce) {
  const auto goal = goal_of(
    {"Put", {"p/b"}, 0, {{"further-left", {}, 0.1}, {"further-back", {}, 0.05}}, {}}, table);
  ASSERT_EQ(goal.spots.size(), 1U);
  const auto& from = *std::ranges::find(table, "p/b", &TableThing::proxy);
  EXPECT_NEAR(goal.spots.front().x, from.x - 0.1, 1e-9);
  EXPECT_NEAR(goal.spots.front().y, from.y + 0.05, 1e-9);
  EXPECT_THAT(goal.words,
              testing::EndsWith("10 centimetres further left and 5 centimetres further back"));
}

TEST(TableGoals, FurtherByALengthIsThatFar) {
  const auto goal = goal_of({"Put", {"p/b"}, 0, {{"further-left", {}, 0.1}}, {}}, table);
  ASSERT_EQ(goal.spots.size(), 1U);
  EXPECT_NEAR(goal.spots.front().x, 0.0, 1e-9);
  EXPECT_EQ(goal.words, "put the blue ball 10 centimetres further left");
}

TEST(TableGoals, ThingsOfARowHaveASpotEach) {
  const auto goal = goal_of({"Put", {"p/a", "p/b", "p/c"}, 0, {{"in-row", {}}}, {}}, table);
  EXPECT_EQ(goal.words, "put the red ball, the blue ball and the red box in a row");
  EXPECT_EQ(goal.formula, "(and (= (pos a) at-a) (= (pos b) spot-of-b) (= (pos c) at-c))");
  // What stands right already is not moved.
  EXPECT_EQ(goal.spots.size(), 1U);
  EXPECT_EQ(refused({"Put", {"p/a"}, 0, {{"in-row", {}}}, {}}), "That takes two things at least.");
}

} // namespace castor::planning
