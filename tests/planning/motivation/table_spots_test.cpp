#include "castor/planning/motivation/table_spots.hpp"

#include "castor/planning/motivation/table_goals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace castor::planning {

namespace {

using communication::DirectiveStep;

TableThing made(const std::string& name, const std::string& shape, double x, double y) {
  TableThing result{"p/" + name, name, "at-" + name, "the " + name, x, {{"shape", shape}}};
  result.y = y;
  result.height = 0.05;
  return result;
}

/// A ball on the left, a box on the right, a disc in front and a can at the back.
std::vector<TableThing> spotted() {
  std::vector<TableThing> result{made("ball", "sphere", -0.2, 0.0), made("box", "cube", 0.1, 0.0),
                                 made("disc", "circle", 0.0, -0.12),
                                 made("can", "cylinder", 0.05, 0.12)};
  result[0].height = 0.06;
  result[3].height = 0.09;
  return result;
}

TableSpot spot_for(const std::string& relation, const std::vector<std::string>& landmarks,
                   double distance = 0, const std::string& what = "disc") {
  const auto goal = goal_of(
    DirectiveStep{"Put", {"p/" + what}, 0, {{relation, landmarks, distance}}, {}}, spotted());
  EXPECT_EQ(goal.wish, TableWish::goal) << goal.words;
  EXPECT_EQ(goal.formula, "(and (= (pos " + what + ") spot-of-" + what + "))");
  return goal.spots.empty() ? TableSpot{} : goal.spots.front();
}

std::string words_of(const DirectiveStep& step, const std::vector<TableThing>& things = spotted()) {
  return goal_of(step, things).words;
}

} // namespace

TEST(TableSpots, MidwayIsHalfWay) {
  const auto at = spot_for("midway", {"p/ball", "p/box"});
  EXPECT_NEAR(at.x, -0.05, 1e-9);
  EXPECT_NEAR(at.y, 0.0, 1e-9);
}

/// The disc is seen from the box in the same direction as before.
TEST(TableSpots, CloserHalvesTheGapAndFartherWidensIt) {
  const auto things = spotted();
  const auto& disc = things[2];
  const auto& box = things[1];
  const double way = std::hypot(disc.x - box.x, disc.y - box.y);
  const double gap = way - disc.radius - box.radius;
  const auto is_at = [&](const TableSpot& spot, double wanted) {
    const double share = (wanted + disc.radius + box.radius) / way;
    EXPECT_NEAR(spot.x, box.x + share * (disc.x - box.x), 1e-9);
    EXPECT_NEAR(spot.y, box.y + share * (disc.y - box.y), 1e-9);
  };
  is_at(spot_for("closer", {"p/box"}), gap / 2);
  is_at(spot_for("closer", {"p/box"}, 0.03), gap - 0.03);
  is_at(spot_for("farther", {"p/box"}, 0.02), gap + 0.02);
}

TEST(TableSpots, WhatIsCloseCannotBeCloser) {
  auto things = spotted();
  things[2].x = things[1].x;
  things[2].y = things[1].y - things[1].radius - things[2].radius - 0.01;
  EXPECT_EQ(words_of({"Put", {"p/disc"}, 0, {{"closer", {"p/box"}}}, {}}, things),
            "There is no room for the disc closer to the box.");
}

TEST(TableSpots, WhatIsTakenIsNoPlaceMidway) {
  auto things = spotted();
  things[3].x = -0.05;
  things[3].y = 0.0;
  EXPECT_EQ(words_of({"Put", {"p/disc"}, 0, {{"midway", {"p/ball", "p/box"}}}, {}}, things),
            "There is no room for the disc half-way between the ball and the box.");
}

TEST(TableSpots, EquidistantIsAsFarFromBoth) {
  const auto at = spot_for("equidistant", {"p/ball", "p/box"});
  EXPECT_NEAR(std::hypot(at.x + 0.2, at.y), std::hypot(at.x - 0.1, at.y), 1e-9);
  // The nearest such place to where it is.
  EXPECT_LT(at.y, -0.05);
}

TEST(TableSpots, InLineIsOnTheLineThroughBoth) {
  EXPECT_NEAR(spot_for("in-line", {"p/ball", "p/box"}).y, 0.0, 1e-9);
}

TEST(TableSpots, LevelIsInTheRowOfAThingOrInItsColumn) {
  const auto disc = spotted()[2];
  const auto box = spotted()[1];
  EXPECT_NEAR(spot_for("level", {"p/box"}).y, box.y, 1e-9);
  EXPECT_NEAR(spot_for("level-across", {"p/box"}).x, box.x, 1e-9);
  // "In line with it" is the nearer one of both.
  const auto at = spot_for("in-line", {"p/box"});
  EXPECT_NEAR(std::hypot(at.x - disc.x, at.y - disc.y),
              std::min(std::abs(box.x - disc.x), std::abs(box.y - disc.y)), 0.05);
}

TEST(TableSpots, DistancesFromEdgesAreThoseOfTheThing) {
  const auto disc = spotted()[2];
  EXPECT_NEAR(spot_for("left-edge", {}, 0.05).x, -table_half_width + disc.radius + 0.05, 1e-9);
  EXPECT_NEAR(spot_for("back-edge", {}, 0.06).y, table_half_depth - disc.radius - 0.06, 1e-9);
}

TEST(TableSpots, TowardsTheMiddleIsAsFarAsSaid) {
  const auto disc = spotted()[2];
  const double way = std::hypot(disc.x, disc.y);
  const auto at = spot_for("centre", {}, 0.04);
  EXPECT_NEAR(std::hypot(at.x, at.y), way - 0.04, 1e-9);
}

TEST(TableSpots, TheOtherSideIsThatAwayFromWhereItIs) {
  const auto at = spot_for("other-side", {"p/box"}, 0, "ball");
  EXPECT_GT(at.x, 0.15);
  EXPECT_NEAR(at.y, 0.0, 1e-9);
}

TEST(TableSpots, GapsAreAsWideAsSaid) {
  const auto left = spot_for("left", {"p/box"}, 0.05);
  EXPECT_NEAR(0.1 - left.x, 0.03 + 0.03 + 0.05, 1e-9);
  const auto near = spot_for("near", {"p/ball"}, 0.08);
  EXPECT_NEAR(std::hypot(near.x + 0.2, near.y), 0.14, 1e-9);
}

TEST(TableSpots, WhereThereIsRoomIsFarFromEverything) {
  const auto at = spot_for("roomiest", {});
  for (const auto& x : spotted())
    if (x.object != "disc") {
      EXPECT_GT(std::hypot(at.x - x.x, at.y - x.y), 0.15) << x.object;
    }
}

TEST(TableSpots, AreWhereTheThingCanBePut) {
  const auto in_front = [](const TableThing&, double, double y) {
    return y < -0.05 ? spatial::Reach::direct : spatial::Reach::none;
  };
  const auto things = spotted();
  const DirectiveStep beside{"Put", {"p/disc"}, 0, {{"near", {"p/ball"}, 0.05}}, {}};
  const auto goal = goal_of(beside, things, in_front);
  ASSERT_EQ(goal.spots.size(), 1U) << goal.words;
  EXPECT_LT(goal.spots.front().y, -0.05);
  EXPECT_EQ(
    goal_of({"Put", {"p/disc"}, 0, {{"left", {"p/box"}, 0.05}}, {}}, things, in_front).words,
    "There is no room for the disc 5 centimetres to the left of the box.");
  const auto roomiest =
    goal_of({"Put", {"p/disc"}, 0, {{"roomiest", {}}}, {}}, things, in_front).spots;
  ASSERT_EQ(roomiest.size(), 1U);
  EXPECT_LT(roomiest.front().y, -0.05);
  // Rather where it need not be put down on its way.
  const auto by_stop = [](const TableThing&, double, double y) {
    return y > 0.05 ? spatial::Reach::direct : spatial::Reach::by_stop;
  };
  EXPECT_GT(goal_of(beside, things, by_stop).spots.front().y, 0.05);
}

TEST(TableReach, IsAsSpatialHasTold) {
  spatial::ReachQuery told;
  told.low = {0, 0};
  told.step = 0.1;
  told.columns = 2;
  told.rows = 1;
  told.things = {{"location", 0.05, {spatial::Reach::by_stop, spatial::Reach::none}}, {"other"}};
  const auto things = spotted();
  const auto reach = reach_told(told, {"ball", "box"});
  EXPECT_EQ(reach(things[0], 0.05, 0.05), spatial::Reach::by_stop);
  EXPECT_EQ(reach(things[0], 0.15, 0.05), spatial::Reach::none);
  EXPECT_EQ(reach(things[0], 0.05, 0.15), spatial::Reach::none);
  EXPECT_EQ(reach(things[0], -0.01, 0.05), spatial::Reach::none);
  // Of others nothing was told.
  for (const auto& x : {things[1], things[2]})
    EXPECT_EQ(reach(x, 0.15, 0.05), spatial::Reach::direct);
}

TEST(TableSpots, TwoThingsStandOnBothSidesAsFarAway) {
  const auto goal =
    goal_of({"Put", {"p/ball", "p/disc"}, 0, {{"both-sides", {"p/box"}}}, {}}, spotted());
  ASSERT_EQ(goal.spots.size(), 2U) << goal.words;
  EXPECT_NEAR(goal.spots[0].x + goal.spots[1].x, 0.2, 1e-9);
  EXPECT_LT(goal.spots[0].x, 0.1);
  EXPECT_EQ(words_of({"Put", {"p/ball"}, 0, {{"both-sides", {"p/box"}}}, {}}),
            "I can put two things on both sides of one.");
}

TEST(TableSpots, NothingIsMovedOffTheTable) {
  EXPECT_EQ(words_of({"Put", {"p/ball"}, 0, {{"further-left", {}, 0.9}}, {}}),
            "There the ball would not be on the table any more.");
}

TEST(TableSpots, OnTopIsOnWhatIsStacked) {
  auto things = spotted();
  const DirectiveStep step{"Put", {"p/disc"}, 0, {{"on-top", {}}}, {}};
  EXPECT_EQ(words_of(step, things),
            "I do not know on top of what: tell me on which thing to put it.");
  things[3].on = "box";
  EXPECT_EQ(goal_of(step, things).formula, "(and (on disc can))");
}

TEST(TableSpots, SeveralThingsGoIntoOneCorner) {
  EXPECT_EQ(goal_of({"Put", {"p/ball", "p/disc"}, 0, {{"corner", {}}}, {}}, spotted()).formula,
            "(and (in-part ball front-left-corner) (near disc ball))");
}

TEST(TableSpots, EachCornerHasAThingOfItsOwn) {
  auto things = spotted();
  things.push_back(made("cup", "cylinder", 0.0, 0.0));
  const std::vector<std::string> all{"p/ball", "p/box", "p/disc", "p/can", "p/cup"};
  DirectiveStep step{"Put", all, 0, {{"each-corner", {}}}, {}};
  const auto goal = goal_of(step, things);
  EXPECT_EQ(goal.formula, "(and (in-part disc front-left-corner) (in-part box front-right-corner) "
                          "(in-part ball back-left-corner) (in-part can back-right-corner))")
    << goal.words;
  // "One thing" is one for each.
  step.number = 1;
  EXPECT_EQ(goal_of(step, things).formula, goal.formula);
  EXPECT_EQ(goal.parts.size(), 4U);
  // With fewer things, as many corners, and those that they can be put in.
  const auto in_front = [](const TableThing&, double, double y) {
    return y < 0 ? spatial::Reach::direct : spatial::Reach::none;
  };
  step.things = {"p/can", "p/ball"};
  EXPECT_EQ(goal_of(step, things, in_front).formula,
            "(and (in-part ball front-left-corner) (in-part can front-right-corner))");
  step.things = all;
  EXPECT_EQ(words_of(step, things), goal.words);
  EXPECT_EQ(goal_of(step, things, in_front).words,
            "I do not reach so many corners of the table with them.");
}

TEST(TableSpots, TheOppositeCornerIsThatOfWhatWasMovedLast) {
  auto things = spotted();
  const DirectiveStep step{"Put", {"p/disc"}, 0, {{"opposite-corner", {}}}, {}};
  EXPECT_EQ(words_of(step, things), "I do not know opposite to which corner: tell me the corner.");
  things[0].y = 0.2;
  things[0].is_last_moved = true;
  EXPECT_EQ(goal_of(step, things).formula, "(and (in-part disc front-right-corner))");
}

TEST(TableSpots, WhatIsSortedByHeightStandsInARow) {
  auto things = spotted();
  const auto goal = goal_of({"Sort", {"p/ball", "p/box", "p/can"}, 0, {}, "height"}, things);
  // What has no spot stands right already.
  const auto x_in = [&](const TableGoal& x, const TableThing& thing) {
    const auto spot = std::ranges::find(x.spots, "spot-of-" + thing.object, &TableSpot::name);
    return spot == x.spots.end() ? thing.x : spot->x;
  };
  EXPECT_EQ(goal.spots.size(), 2U) << goal.words;
  EXPECT_LT(x_in(goal, things[1]), x_in(goal, things[0]));
  EXPECT_LT(x_in(goal, things[0]), x_in(goal, things[3]));
  const auto down = goal_of({"Sort", {"p/ball", "p/box", "p/can"}, 0, {}, "height-down"}, things);
  EXPECT_LT(x_in(down, things[3]), x_in(down, things[0]));
  EXPECT_LT(x_in(down, things[0]), x_in(down, things[1]));
}

TEST(TableSpots, ARowAlongAnEdgeIsARowThere) {
  const auto goal =
    goal_of({"Put", {"p/ball", "p/disc"}, 0, {{"in-row", {}}, {"back-edge", {}}}, {}}, spotted());
  EXPECT_EQ(goal.formula, "(and (= (pos ball) spot-of-ball) (= (pos disc) spot-of-disc))");
  ASSERT_EQ(goal.spots.size(), 2U);
  EXPECT_NEAR(goal.spots[0].y, goal.spots[1].y, 1e-9);
  EXPECT_GE(goal.spots[0].y, 0.13);
}

TEST(TableSpots, WhatWasToBeRememberedIsMadeAgain) {
  auto things = spotted();
  const DirectiveStep step{"PutAsNoted", {}, 0, {}, {}};
  EXPECT_EQ(words_of(step, things),
            "I was not told to remember how things were. Say 'remember this' for that.");
  things[0].waypoint_noted = "place-1";
  things[1].waypoint_noted = "at-box";
  EXPECT_EQ(goal_of(step, things).formula, "(and (= (pos ball) place-1))");
  EXPECT_EQ(goal_of({"Note", {}, 0, {}, {}}, things).wish, TableWish::note);
}

TEST(TableAnswers, DistancesAndSizes) {
  EXPECT_EQ(words_of({"HowFar", {"p/ball", "p/box"}, 0, {}, {}}),
            "About 30 centimetres from middle to middle.");
  EXPECT_EQ(words_of({"HowTall", {"p/can", "p/box"}, 0, {}, {}}),
            "The can is about 9 centimetres high, the box is about 5 centimetres high: it is "
            "higher.");
  EXPECT_EQ(words_of({"HowWide", {"p/ball"}, 0, {}, {}}), "The ball is about 6 centimetres wide.");
  EXPECT_EQ(words_of({"HowWide", {"p/box"}, 0, {}, {}}), "The box is about 5 centimetres wide.");
  EXPECT_EQ(words_of({"ClosestPair", {"p/ball", "p/box", "p/can"}, 0, {}, {}}),
            "The box and the can: they are about 13 centimetres apart.");
  EXPECT_EQ(words_of({"FarthestPair", {"p/ball", "p/box", "p/can"}, 0, {}, {}}),
            "The ball and the box: they are about 30 centimetres apart.");
}

TEST(TableAnswers, ThingsInAnOrder) {
  auto things = spotted();
  const std::vector<std::string> all{"p/ball", "p/box", "p/disc", "p/can"};
  EXPECT_EQ(words_of({"ListFromLeft", all, 0, {}, {}}, things),
            "From left to right: the ball, the disc, the can and the box.");
  EXPECT_EQ(words_of({"ListFromBack", all, 0, {}, {}}, things),
            "From back to front: the can, the ball, the box and the disc.");
  EXPECT_EQ(words_of({"ListFromHighest", {"p/ball", "p/can"}, 0, {}, {}}, things),
            "From high to low: the can and the ball.");
  things[0].is_held = true;
  EXPECT_EQ(words_of({"ListFromRight", {"p/ball", "p/box"}, 0, {}, {}}, things),
            "From right to left: the box.");
}

TEST(TableAnswers, WhatIsNotWhereItWasAtFirst) {
  auto things = spotted();
  EXPECT_EQ(words_of({"Displaced", {}, 0, {}, {}}, things), "Everything is where it was at first.");
  for (auto& x : things)
    x.waypoint_before = "place-9";
  // It was moved, and moved back.
  things[0].waypoint_at_first = things[0].waypoint;
  things[1].waypoint_at_first = "place-9";
  things[2].waypoint_at_first = things[2].waypoint;
  things[3].waypoint_at_first = things[3].waypoint;
  EXPECT_EQ(words_of({"Displaced", {}, 0, {}, {}}, things),
            "The box is not where it was at first.");
  EXPECT_EQ(words_of({"Displaced", {"p/box"}, 0, {}, {}}, things),
            "No, the box is not where it was at first.");
  EXPECT_EQ(words_of({"Displaced", {"p/ball"}, 0, {}, {}}, things),
            "Yes, the ball is where it was at first.");
}

TEST(TableAnswers, WhetherThingsTouch) {
  auto things = spotted();
  EXPECT_EQ(words_of({"Touching", {"p/ball", "p/box"}, 0, {}, {}}, things).substr(0, 16),
            "No: there are ab");
  things[1].x = things[0].x + (things[0].width() + things[1].width()) / 2;
  things[1].y = things[0].y;
  EXPECT_EQ(words_of({"Touching", {"p/ball", "p/box"}, 0, {}, {}}, things),
            "Yes, or nearly: I see no gap between them.");
  things[0].on = things[3].object;
  EXPECT_EQ(words_of({"Touching", {"p/ball", "p/can"}, 0, {}, {}}, things),
            "Yes: the ball stands on the other.");
  EXPECT_EQ(goal_of(DirectiveStep{"Touching", {"p/ball"}, 0, {}, {}}, things).wish,
            TableWish::refusal);
}

TEST(TableAnswers, WhatWasMovedAndHowFar) {
  auto things = spotted();
  EXPECT_EQ(words_of({"HaveMoved", {"p/ball"}, 0, {}, {}}, things),
            "No, I have not moved the ball.");
  things[0].waypoint_before = "place-1";
  things[0].spot_before = {"place-1", -0.1, 0.0};
  EXPECT_EQ(words_of({"HaveMoved", {"p/ball", "p/box"}, 0, {}, {}}, things),
            "Yes, I have moved the ball, but not the box.");
  EXPECT_EQ(words_of({"HowFarMoved", {"p/ball", "p/box"}, 1, {}, {}}, things),
            "I have moved the ball by about 10 centimetres.");
  EXPECT_EQ(words_of({"HowFarMoved", {"p/box"}, 0, {}, {}}, things), "I have not moved the box.");
}

TEST(TableAnswers, WhatIsForbidden) {
  auto things = spotted();
  EXPECT_EQ(words_of({"WhatKept", {}, 0, {}, {}}, things),
            "Nothing is forbidden: I may touch everything.");
  EXPECT_EQ(words_of({"MayTouch", {"p/ball"}, 0, {}, {}}, things), "Yes, I may touch the ball.");
  things[0].is_kept = true;
  things[1].is_kept_clear = true;
  EXPECT_EQ(words_of({"WhatKept", {}, 0, {}, {}}, things),
            "I am not to touch the ball. I am to put nothing on the box.");
  EXPECT_EQ(words_of({"MayTouch", {"p/ball", "p/box"}, 0, {}, {}}, things),
            "No, I was told not to touch the ball.");
}

} // namespace castor::planning
