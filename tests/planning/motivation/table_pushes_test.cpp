#include "castor/planning/motivation/table_goals.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::planning {

namespace {

TableThing pushable(const std::string& name, double x, double y) {
  TableThing result{"p/" + name, name, "at-" + name, "the " + name, x};
  result.y = y;
  return result;
}

const std::vector<TableThing> pushables{pushable("cup", -0.05, 0.02), pushable("tin", 0.09, 0.02),
                                        pushable("die", -0.26, -0.10)};

TableGoal pushed(const std::string& thing, std::vector<communication::DirectivePlace> places) {
  return goal_of({"Push", {"p/" + thing}, 0, std::move(places), {}}, pushables);
}

communication::DirectivePlace by(const std::string& relation, double distance) {
  communication::DirectivePlace result{relation, {}};
  result.distance = distance;
  return result;
}

} // namespace

TEST(TablePushes, GoStraightInTheDirectionThatIsSaid) {
  const auto goal = pushed("cup", {{"front", {}}});
  EXPECT_EQ(goal.formula, "(and (= (pos cup) spot-of-cup))");
  ASSERT_EQ(goal.spots.size(), 1U);
  EXPECT_DOUBLE_EQ(goal.spots[0].x, -0.05);
  EXPECT_NEAR(goal.spots[0].y, -0.06, 1e-9);
  EXPECT_NEAR(goal.push_distance, 0.08, 1e-9);
  EXPECT_EQ(goal.words, "push the cup to the front");
  EXPECT_EQ(goal.result, "I have pushed the cup to the front.");
}

TEST(TablePushes, GoALittleOrAsFarAsIsSaid) {
  EXPECT_NEAR(pushed("cup", {{"slightly-back", {}}}).spots.at(0).y, 0.07, 1e-9);
  EXPECT_NEAR(pushed("cup", {by("further-left", 0.11)}).spots.at(0).x, -0.16, 1e-9);
  EXPECT_NEAR(pushed("cup", {}).push_distance, 0.07, 1e-9);
  EXPECT_NEAR(pushed("cup", {{"some-way", {}}}).push_distance, 0.04, 1e-9);
  EXPECT_EQ(pushed("cup", {}).formula, "(and (pushed cup))");
}

TEST(TablePushes, StopBeforeOthersAndTheEdge) {
  // There is a gap of 8 centimetres, and of 1 to the edge.
  const auto goal = pushed("cup", {{"right", {}}});
  ASSERT_EQ(goal.spots.size(), 1U);
  EXPECT_NEAR(goal.spots[0].x, 0.01, 1e-9);
  EXPECT_EQ(pushed("cup", {by("further-right", 0.12)}).words,
            "I cannot push the cup to the right: the tin is in the way there. Take it away first.");
  EXPECT_EQ(pushed("die", {{"left", {}}}).words,
            "I cannot push the die to the left: there is the edge of the table.");
  // Away from what it stands beside there is room.
  EXPECT_EQ(pushed("tin", {{"right", {}}}).wish, TableWish::goal);
}

TEST(TablePushes, EndWhereTheArmReaches) {
  const auto near = [](const TableThing&, double, double y) {
    return y < 0.06 ? spatial::Reach::direct : spatial::Reach::none;
  };
  EXPECT_NEAR(goal_of({"Push", {"p/cup"}, 0, {{"back", {}}}, {}}, pushables, near).spots.at(0).y,
              0.05, 1e-9);
}

TEST(TablePushes, ToAPlaceThingsAreMoved) {
  EXPECT_EQ(pushed("cup", {{"left-edge", {}}}).formula, "(and (in-part cup left-edge))");
  EXPECT_EQ(pushed("cup", {{"left", {"p/die"}}}).formula, "(and (left-of cup die))");
}

} // namespace castor::planning
