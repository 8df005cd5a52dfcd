#include "castor/planning/tabletop/goal_text.hpp"
#include "castor/planning/tabletop/table_memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::planning {

namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

const ThingOnTable ball{"o1", "p1", {{"colour", "blue"}, {"shape", "sphere"}}, {-0.2, 0.0}, 0.03};
const ThingOnTable box{"o2", "p2", {{"colour", "red"}, {"shape", "cube"}}, {0.1, 0.0}, 0.03};

ThingOnTable seen_as(ThingOnTable x, const std::string& id, spatial::GroundPoint place) {
  x.id = id;
  x.proxy = "proxy of " + id;
  x.place = place;
  return x;
}

/// Names of new places that a goal has.
std::vector<std::string> places_of(const AchieveGoal& goal) {
  std::vector<std::string> result;
  for (const auto& x : goal.objects)
    if (x.type == "waypoint")
      result.push_back(x.name);
  return result;
}

class TableMemoryTest : public testing::Test {
protected:
  TableMemoryTest() { memory.see({ball, box}); }

  std::vector<std::string> facts(const std::string& goal = {},
                                 const std::vector<ThingAtPlace>& places = {}) const {
    auto result = memory.state(goal, places).facts;
    // What the goal does not speak of.
    std::erase_if(result, [](const auto& x) { return x.starts_with("(un"); });
    return result;
  }

  std::string new_place(std::size_t count = 1) {
    TableGoal goal;
    goal.new_places = count;
    return places_of(memory.begin(goal)).front();
  }

  TableMemory memory{"robot", {{"sphere", "ball"}}};
};

TEST_F(TableMemoryTest, SaysWhereThingsAre) {
  EXPECT_THAT(facts({}, {{"o1", {"left", {"o2"}}}, {"o2", {"left-edge", {}}}}),
              testing::UnorderedElementsAre("(= (pos p1) place-1)", "(= (pos p2) place-2)",
                                            "(no-flat-top p1)", "(wp-left-of place-1 p2)",
                                            "(wp-in place-2 left-edge)"));
  const auto things = memory.things({{"o2", {"left", {}}}});
  ASSERT_EQ(things.size(), 2U);
  EXPECT_EQ(things[0].words, "the blue ball");
  EXPECT_EQ(things[1].words, "the red cube");
  EXPECT_THAT(things[1].parts, testing::ElementsAre("left"));
}

TEST_F(TableMemoryTest, KeepsNamesOfThingsThatAreSeenAnew) {
  memory.see({seen_as(ball, "o7", {0.2, 0.1}), box});
  ASSERT_NE(memory.thing("p1"), nullptr);
  EXPECT_EQ(memory.thing("p1")->seen.id, "o7");
  EXPECT_NE(memory.thing("p1")->waypoint, "place-1");
  // What looks different is something else.
  auto other = seen_as(ball, "o8", {0.2, 0.1});
  other.qualities["colour"] = "green";
  memory.see({other, box});
  EXPECT_EQ(memory.thing("p1"), nullptr);
  EXPECT_NE(memory.with_id("o8"), nullptr);
}

TEST_F(TableMemoryTest, ATwinThatStaysIsNotTakenForWhatHasGone) {
  auto twin = seen_as(ball, "o3", {0.0, 0.2});
  memory.see({ball, box, twin});
  memory.see({box, twin});
  EXPECT_EQ(memory.thing("p1"), nullptr);
  EXPECT_EQ(memory.with_id("o3")->name, "proxy^20of^20o3");
}

TEST_F(TableMemoryTest, AChosenPlaceIsThereUntilAThingIsAtIt) {
  const auto place = new_place();
  memory.choose("reposition-right", {place, "p2"});
  EXPECT_EQ(memory.chosen(place), (std::vector<spatial::WantedPlace>{{"right", {"p2"}}}));
  EXPECT_THAT(facts(), Contains("(chosen " + place + ")"));
  EXPECT_THAT(facts(), Contains("(wp-right-of " + place + " p2)"));
  memory.moved("p1", place, "o9", {0.2, 0.0});
  memory.see({seen_as(ball, "o9", {0.2, 0.0}), box});
  EXPECT_THAT(facts(), Contains("(= (pos p1) " + place + ")"));
  EXPECT_THAT(facts(), Not(Contains("(chosen " + place + ")")));
  // Only what is seen there counts now.
  EXPECT_THAT(facts(), Not(Contains("(wp-right-of " + place + " p2)")));
  EXPECT_THAT(facts({}, {{"o9", {"right", {"o2"}}}}), Contains("(wp-right-of " + place + " p2)"));
  // Where it was, something can be put.
  EXPECT_THAT(facts(), Contains("(used place-1)"));
  EXPECT_EQ(*memory.place("place-1"), ball.place);
}

TEST_F(TableMemoryTest, WhatIsFarFromItsLandmarkCountsOnlyWhereItWasPutThere) {
  const ThingAtPlace far{"o1", {"right", {"o2"}}, false};
  EXPECT_THAT(facts({}, {far}), Not(Contains("(wp-right-of place-1 p2)")));
  const auto place = new_place();
  memory.choose("reposition-right", {place, "p2"});
  memory.moved("p1", place, "o1", {0.25, 0.0});
  memory.see({seen_as(ball, "o1", {0.25, 0.0}), box});
  EXPECT_THAT(facts({}, {far}), Contains("(wp-right-of " + place + " p2)"));
  // For another goal it is to be brought nearer.
  new_place();
  EXPECT_THAT(facts({}, {far}), Not(Contains("(wp-right-of " + place + " p2)")));
}

TEST_F(TableMemoryTest, KnowsWhereAGoalHasThingsPushed) {
  TableGoal goal;
  goal.formula = "(and (= (pos p1) spot-of-p1))";
  goal.spots = {{"spot-of-p1", 0.07, 0.02}};
  goal.push_distance = 0.08;
  memory.begin(goal);
  const auto* place = memory.wanted_place("p1");
  ASSERT_NE(place, nullptr);
  EXPECT_EQ(*place, (spatial::GroundPoint{0.07, 0.02}));
  EXPECT_EQ(memory.wanted_place("p2"), nullptr);
  EXPECT_EQ(memory.push_distance(), 0.08);
  EXPECT_TRUE(memory.is_pushed_to("place-3"));
  EXPECT_FALSE(memory.is_pushed_to("place-1"));
  memory.begin({});
  EXPECT_FALSE(memory.is_pushed_to("place-3"));
}

TEST_F(TableMemoryTest, WhatStandsOnAnotherThingIsKept) {
  const auto place = new_place();
  memory.choose("reposition-on", {place, "p2"});
  memory.moved("p1", place, {}, box.place);
  auto both = seen_as(box, "o5", {0.1, 0.01});
  both.qualities["colour"] = "blue";
  memory.see({both});
  ASSERT_NE(memory.thing("p2"), nullptr);
  EXPECT_EQ(memory.thing("p2")->seen.id, "o5");
  EXPECT_THAT(facts(), Contains("(wp-on " + place + " p2)"));
  EXPECT_EQ(memory.things({}).size(), 2U);
}

TEST_F(TableMemoryTest, WhatIsHeldIsKeptUntilItIsLost) {
  memory.taken("p1");
  memory.see({box});
  EXPECT_THAT(facts(), Contains("(= (pos p1) hand)"));
  EXPECT_TRUE(memory.things({}).front().is_held);
  memory.released();
  memory.see({box});
  EXPECT_EQ(memory.thing("p1"), nullptr);
}

TEST_F(TableMemoryTest, WhatAnybodyHasTakenIsHeld) {
  memory.holds("o1");
  memory.see({box});
  EXPECT_THAT(facts(), Contains("(= (pos p1) hand)"));
  EXPECT_EQ(memory.thing("p1")->waypoint_before, "place-1");
  // The gripper holds something that is not known.
  memory.holds("");
  EXPECT_FALSE(memory.thing("p1")->is_held);
}

TEST_F(TableMemoryTest, NothingIsForgottenWhileNotAllIsKnownThatIsSeen) {
  memory.see({box}, false);
  EXPECT_NE(memory.thing("p1"), nullptr);
  memory.see({box, seen_as(ball, "o7", {0.2, 0.1})}, false);
  EXPECT_EQ(memory.thing("p1")->seen.id, "o7");
  memory.see({box});
  EXPECT_EQ(memory.thing("p1"), nullptr);
}

TEST_F(TableMemoryTest, ASuccessorKnowsWhatItKnew) {
  const auto place = new_place(2);
  memory.choose("reposition-on", {place, "p2"});
  memory.moved("p1", place, {}, box.place);
  memory.pushed("p2");
  memory.choose("reposition-right", {"place-9", "p2"});
  memory.taken("p2");
  const auto before = memory.remembered();
  TableMemory successor{"robot", {{"sphere", "ball"}}};
  successor.recall(before);
  EXPECT_EQ(successor.remembered(), before);
  EXPECT_EQ(successor.state({}, {}).facts, memory.state({}, {}).facts);
  EXPECT_EQ(successor.thing("p1")->on, "p2");
  EXPECT_EQ(successor.thing("p1")->waypoint_before, "place-1");
  EXPECT_TRUE(successor.thing("p2")->is_held);
  EXPECT_EQ(successor.things({}).front().words, "the blue ball");
  EXPECT_EQ(successor.chosen("place-9"), memory.chosen("place-9"));
}

TEST_F(TableMemoryTest, WhatRefersToNothingIsNotRecalled) {
  auto damaged = memory.remembered();
  damaged.things[0].on = "p9";
  damaged.things[1].waypoint = "place-9";
  memory.recall(damaged);
  ASSERT_NE(memory.thing("p1"), nullptr);
  EXPECT_EQ(memory.thing("p1")->on, "");
  EXPECT_EQ(memory.thing("p2"), nullptr);
  memory.see({ball, box});
  EXPECT_NE(memory.thing("p2"), nullptr);
}

TEST_F(TableMemoryTest, ANewGoalForgetsWhatWasChosenAndDone) {
  const auto place = new_place();
  memory.choose("reposition-free", {place});
  memory.pushed("p1");
  EXPECT_THAT(facts(), Contains("(pushed p1)"));
  EXPECT_NE(new_place(), place);
  EXPECT_THAT(facts(), Not(Contains("(pushed p1)")));
  EXPECT_THAT(memory.chosen(place), IsEmpty());
}

TEST_F(TableMemoryTest, WhatIsInTheWayIsMovedBeforeIfTheGoalIsAboutIt) {
  const auto place = new_place();
  const std::string goal = "(and (in-part p1 left) (in-part p2 right))";
  const std::string in_way = "(in-way p2 p1)";
  memory.refused("p1", {"o2"});
  EXPECT_THAT(facts(goal), Contains(in_way));
  EXPECT_THAT(facts("(in-part p1 left)"), Not(Contains(in_way)));
  EXPECT_THAT(facts("(near p1 p2)"), Not(Contains(in_way)));
  // Only one can come first.
  memory.refused("p2", {"o1"});
  EXPECT_THAT(facts(goal), Not(Contains("(in-way p1 p2)")));
  memory.choose("reposition-in", {place, "right"});
  memory.moved("p2", place, "o2", {0.2, 0.1});
  EXPECT_THAT(facts(goal), Not(Contains(in_way)));
  memory.refused("p1", {"o2", "unknown"});
  EXPECT_THAT(facts(goal), Not(Contains(in_way)));
  memory.refused("p1", {"o2"});
  new_place();
  EXPECT_THAT(facts(goal), Not(Contains(in_way)));
}

TEST_F(TableMemoryTest, ThatSomethingIsElsewhereIsKnownByWhatWasDone) {
  const auto place = new_place();
  memory.choose("reposition-in", {place, "elsewhere"});
  memory.moved("p1", place, "o1", {0.0, 0.2});
  EXPECT_THAT(facts("(in-part p1 elsewhere)"), Contains("(wp-in " + place + " elsewhere)"));
  EXPECT_THAT(facts(), Not(Contains("(wp-in " + place + " elsewhere)")));
}

TEST_F(TableMemoryTest, KnowsThingsByTheProxiesThatTheyHad) {
  memory.see({seen_as(ball, "o9", {0.3, 0}), box});
  const auto things = memory.things({});
  ASSERT_EQ(things.size(), 2U);
  EXPECT_EQ(things.front().proxy, "proxy of o9");
  EXPECT_THAT(things.front().former_proxies, Contains("p1"));
  TableMemory successor{"robot"};
  successor.recall(memory.remembered());
  EXPECT_THAT(successor.things({}).front().former_proxies, Contains("p1"));
}

TEST_F(TableMemoryTest, KnowsWhereThingsWereBeforeTheLastGoalThatMovedSomething) {
  const auto before = [&](const std::string& proxy) {
    for (const auto& x : memory.things({}))
      if (x.proxy == proxy)
        return x.waypoint_before_goal;
    return std::string{"not seen"};
  };
  // In two steps.
  memory.moved("p1", new_place(), "o1", {0.0, 0.2});
  memory.moved("p1", "place-1", "o1", {0.2, 0.2});
  EXPECT_EQ(before("p1"), "place-1");
  EXPECT_EQ(before("p2"), "");
  // A goal that moves nothing changes nothing.
  new_place();
  EXPECT_EQ(before("p1"), "place-1");
  memory.moved("p2", new_place(), "o2", {-0.2, 0.2});
  EXPECT_EQ(before("p1"), "");
  EXPECT_EQ(before("p2"), "place-2");
}

TEST_F(TableMemoryTest, KnowsWhereThingsWereBeforeTheyWereMovedForTheFirstTime) {
  EXPECT_FALSE(memory.things({}).front().was_moved());
  memory.moved("p1", new_place(), "o1", {0.0, 0.2});
  memory.moved("p1", new_place(), "o1", {0.2, 0.2});
  const auto moved = memory.things({}).front();
  EXPECT_EQ(moved.waypoint_at_first, "place-1");
  EXPECT_EQ(moved.spot_before.name, moved.waypoint_before);
  EXPECT_EQ(moved.spot_before.x, 0.0);
  EXPECT_EQ(moved.spot_before.y, 0.2);
  TableMemory successor{"robot"};
  successor.recall(memory.remembered());
  EXPECT_EQ(successor.things({}).front().waypoint_at_first, "place-1");
  EXPECT_EQ(successor.things({}).back().waypoint_at_first, "");
}

TEST_F(TableMemoryTest, GivesSpotsOfAGoalWaypointsThatAreFreeForTheirThings) {
  TableGoal goal;
  goal.formula = "(and (= (pos p1) spot-of-p1))";
  goal.spots = {{"spot-of-p1", -0.16, 0.0}};
  const auto begun = memory.begin(goal);
  EXPECT_EQ(begun.goal, "(and (= (pos p1) place-3))");
  ASSERT_NE(memory.place("place-3"), nullptr);
  EXPECT_EQ(memory.place("place-3")->x, -0.16);
  // The ball itself is nearer than other things may be.
  EXPECT_THAT(facts(begun.goal), Contains("(used place-3)"));
  EXPECT_THAT(facts("(and (= (pos p2) place-3))"), Not(Contains("(used place-3)")));
}

TEST_F(TableMemoryTest, KnowsWhatIsNotToBeTouched) {
  TableGoal goal;
  goal.wish = TableWish::keep;
  goal.things = {"p2"};
  memory.keep(goal);
  EXPECT_THAT(facts(), Contains("(kept p2)"));
  EXPECT_THAT(facts(), Contains("(no-flat-top p2)"));
  EXPECT_THAT(facts(), Not(Contains("(kept p1)")));
  TableMemory successor{"robot"};
  successor.recall(memory.remembered());
  EXPECT_TRUE(successor.things({}).back().is_kept);
  // It is the same thing when it is seen anew.
  successor.see({ball, seen_as(box, "o3", {0.11, 0.0})});
  EXPECT_TRUE(successor.things({}).back().is_kept);
  goal.wish = TableWish::allow;
  memory.keep(goal);
  EXPECT_THAT(facts(), Not(Contains("(kept p2)")));
  EXPECT_THAT(facts(), Not(Contains("(no-flat-top p2)")));
}

TEST_F(TableMemoryTest, KnowsWhatNothingIsToBePutOn) {
  TableGoal goal;
  goal.wish = TableWish::keep_clear;
  goal.things = {"p2"};
  memory.keep(goal);
  EXPECT_THAT(facts(), Contains("(no-flat-top p2)"));
  EXPECT_THAT(facts(), Not(Contains("(kept p2)")));
}

/// Both go to the right, one to nearly where the other is now.
TEST_F(TableMemoryTest, WhatIsMovedSomewhereElseLeavesRoomForAnother) {
  TableGoal goal;
  goal.formula = "(and (= (pos p1) spot-of-p1) (= (pos p2) spot-of-p2))";
  goal.spots = {{"spot-of-p1", 0.12, 0.01}, {"spot-of-p2", 0.25, 0.0}};
  const auto begun = memory.begin(goal).goal;
  const std::string spot{waypoint_wanted(begun, "p1")};
  EXPECT_THAT(facts(begun), Contains("(used " + spot + ")"));
  EXPECT_THAT(facts(begun), Contains("(in-way p2 p1)"));
  EXPECT_THAT(facts(begun), Not(Contains("(in-way p1 p2)")));
  // Unless it stays.
  const auto alone = "(and (= (pos p1) " + spot + "))";
  EXPECT_THAT(facts(alone), Not(Contains("(used " + spot + ")")));
  EXPECT_THAT(facts(alone), Not(Contains("(in-way p2 p1)")));
}

TEST_F(TableMemoryTest, RemembersHowThingsWereWhenToldTo) {
  memory.note_places();
  memory.moved("p1", "place-7", "o1", {0.2, 0.1});
  auto things = memory.things({});
  EXPECT_EQ(things[0].waypoint_noted, "place-1");
  EXPECT_EQ(things[0].waypoint, "place-7");
  EXPECT_TRUE(things[0].is_last_moved);
  memory.moved("p2", "place-8", "o2", {-0.2, 0.1});
  TableMemory successor{"robot"};
  successor.recall(memory.remembered());
  things = successor.things({});
  EXPECT_EQ(things[0].waypoint_noted, "place-1");
  EXPECT_FALSE(things[0].is_last_moved);
  EXPECT_TRUE(things[1].is_last_moved);
}

/// Of a tower, vision sees parts: the rest of a cylinder looks like a ball, and one thing like two.
TEST_F(TableMemoryTest, WhatIsSeenOfAStackIsWhatStandsThere) {
  const ThingOnTable cylinder{"o3",       "p3", {{"colour", "yellow"}, {"shape", "cylinder"}},
                              {0.2, 0.1}, 0.03, 0.08};
  memory.see({ball, box, cylinder});
  TableGoal goal;
  goal.new_places = 1;
  const auto place = places_of(memory.begin(goal)).front();
  memory.choose("reposition-on", {place, "p2"});
  memory.moved("p3", place, "o4", {0.1, 0.0});
  auto upper = seen_as(cylinder, "o5", {0.1, 0.04});
  upper.qualities["shape"] = "triangle";
  auto rest = seen_as(cylinder, "o6", {0.11, 0.06});
  auto lower = box;
  lower.qualities["shape"] = "sphere";
  memory.see({ball, lower, upper, rest});
  const auto things = memory.things({});
  ASSERT_EQ(things.size(), 3u);
  EXPECT_EQ(things[1].qualities.at("shape"), "cube");
  EXPECT_EQ(things[2].qualities.at("shape"), "cylinder");
  EXPECT_EQ(things[2].proxy, "proxy of o5");
  EXPECT_EQ(things[2].on, "p2");
  // What is beside it is no part of it.
  memory.see({ball, lower, upper, seen_as(cylinder, "o7", {0.22, 0.0})});
  EXPECT_EQ(memory.things({}).size(), 4u);
}

TEST_F(TableMemoryTest, KnowsWhatHasReturnedUntilItIsMovedAgain) {
  TableGoal back;
  back.is_return = true;
  memory.begin({});
  memory.moved("p1", "place-7", "o1", {0.2, 0.1});
  EXPECT_FALSE(memory.things({})[0].has_returned);
  memory.begin(back);
  memory.taken("p1");
  EXPECT_FALSE(memory.things({})[0].has_returned);
  memory.moved("p1", "place-1", "o1", {0, 0});
  EXPECT_TRUE(memory.things({})[0].has_returned);
  TableMemory successor{"robot"};
  successor.recall(memory.remembered());
  EXPECT_TRUE(successor.things({})[0].has_returned);
  memory.begin({});
  EXPECT_TRUE(memory.things({})[0].has_returned);
  memory.moved("p1", "place-8", "o1", {0.2, 0.1});
  EXPECT_FALSE(memory.things({})[0].has_returned);
}

TEST_F(TableMemoryTest, RemembersItsMovesInTheirOrder) {
  const auto name = memory.things({})[0].words;
  memory.taken("p1");
  memory.moved("p1", "place-7", "o1", {0.2, 0.1});
  memory.moved("p2", "place-8", "o2", {-0.2, 0.1});
  memory.moved("p1", "place-9", "o1", {0.0, 0.1});
  EXPECT_EQ(memory.history().moves, 3U);
  TableMemory successor{"robot"};
  successor.recall(memory.remembered());
  EXPECT_EQ(successor.history(), memory.history());
  ASSERT_EQ(successor.history().remembered.size(), 3U);
  EXPECT_EQ(successor.history().remembered[2], (TableMove{"p1", name}));
  EXPECT_EQ(successor.history().remembered[1].object, "p2");
}

/// The arm puts it down on its way, to grasp it anew.
TEST_F(TableMemoryTest, WhatIsCarriedWithStopsIsMovedOnce) {
  const auto name = new_place();
  const auto first = memory.things({}).front().waypoint;
  memory.carries("p1");
  memory.see({seen_as(ball, "o1", {0.1, -0.2}), box});
  memory.see({seen_as(ball, "o1", {-0.1, -0.2}), box});
  memory.carries("p1");
  memory.moved("p1", name, "o1", {0.0, 0.2});
  const auto moved = memory.things({}).front();
  EXPECT_EQ(moved.waypoint, name);
  EXPECT_EQ(moved.waypoint_before_goal, first);
  EXPECT_EQ(moved.waypoint_before, first);
  EXPECT_EQ(memory.history().moves, 1U);
  // Also if it stays at a stop.
  new_place();
  memory.carries("p2");
  memory.see({seen_as(ball, "o1", {0.0, 0.2}), seen_as(box, "o2", {-0.2, -0.2})});
  EXPECT_TRUE(memory.things({}).back().was_moved());
  EXPECT_EQ(memory.history().moves, 2U);
  // Others may move it as well.
  new_place();
  memory.see({seen_as(ball, "o1", {0.2, 0.2}), seen_as(box, "o2", {-0.2, 0.0})});
  EXPECT_EQ(memory.history().moves, 2U);
}

TEST_F(TableMemoryTest, ForgetsItsFirstMovesButNotHowManyThereWere) {
  for (int i = 0; i < 100; ++i)
    memory.moved("p1", "place-" + std::to_string(50 + i), "o1", {0.2, 0.1});
  EXPECT_EQ(memory.history().moves, 100U);
  EXPECT_LT(memory.history().remembered.size(), 100U);
}

TEST_F(TableMemoryTest, TellsWhatStandsOnWhat) {
  const auto place = new_place();
  memory.choose("reposition-on", {place, "p2"});
  memory.moved("p1", place, "", {0.1, 0.0});
  EXPECT_EQ(memory.things({}).front().on, "p2");
  EXPECT_DOUBLE_EQ(memory.things({}).front().height, 0.05);
}

} // namespace

} // namespace castor::planning
