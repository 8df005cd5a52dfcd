// What people say of boxes, of towers and of what touches what, and whether it is so.
#include "castor/tests/communication/picture_scene.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

constexpr double box_side = 0.1;

/// A tower of blocks, its base first.
std::vector<PicturedItem> tower(const std::vector<std::string>& from_below) {
  constexpr double block = 0.02;
  std::vector<PicturedItem> result;
  for (auto& colour : from_below)
    result.push_back({"square", colour, 0.04, static_cast<double>(result.size()) * block, block});
  return result;
}

/// Three towers: black, yellow on blue; two blue blocks; yellow.
PictureScene towers() {
  PictureScene scene;
  scene.add_box(tower({"black", "blue", "yellow"}), box_side, true);
  scene.add_box(tower({"blue", "blue"}), box_side, true);
  scene.add_box(tower({"yellow"}), box_side, true);
  return scene;
}

/// A black circle at the left wall and a large blue square in a corner; two yellow triangles, one
/// of them at the floor; a small black circle between two yellow squares.
PictureScene boxes() {
  PictureScene scene;
  scene.add_box({{"circle", "black", 0, 0.04, 0.02}, {"square", "blue", 0.07, 0.07, 0.03}},
                box_side, false);
  scene.add_box({{"triangle", "yellow", 0.02, 0, 0.02}, {"triangle", "yellow", 0.05, 0.05, 0.02}},
                box_side, false);
  scene.add_box({{"square", "yellow", 0.01, 0.04, 0.02},
                 {"circle", "black", 0.045, 0.045, 0.01},
                 {"square", "yellow", 0.07, 0.04, 0.02}},
                box_side, false);
  return scene;
}

std::string reply(const PictureScene& scene, const std::string& statement) {
  TableTalk talk{[&scene](auto& asked) { return scene.reply(asked); }};
  return talk.say(statement).text;
}

/// "true", "false", or what was said instead.
std::string judgement(const PictureScene& scene, const std::string& statement) {
  TableTalk talk{[&scene](auto& asked) { return scene.reply(asked); }};
  const auto reply = talk.say(statement);
  if (reply.relation == RhetoricalRelation::acceptance)
    return "true";
  return reply.relation == RhetoricalRelation::correction ? "false" : reply.text;
}

struct Case {
  const char* statement;
  bool is_true;
};

void expect(const PictureScene& scene, const std::vector<Case>& cases) {
  for (auto& [statement, is_true] : cases)
    EXPECT_EQ(judgement(scene, statement), is_true ? "true" : "false") << statement;
}

} // namespace

TEST(Statements, CountWhatIsInBoxes) {
  expect(boxes(), {{"There is a box with exactly three items.", true},
                   {"There is a box with four items.", false},
                   {"Each box has at least two items.", true},
                   {"Two of the three boxes contain a black circle.", true},
                   {"One of the boxes has only yellow items.", true},
                   {"No box contains a blue circle.", true},
                   {"There are two grey squares with a circle.", true},
                   {"There are three squares.", true},
                   {"In each box there is a black circle.", false},
                   {"There is a box with more squares than circles.", true}});
}

TEST(Statements, SayWhatATowerConsistsOf) {
  expect(towers(), {{"There is a tower with two blue blocks.", true},
                    {"There is a blue tower.", true},
                    {"There is a black tower.", false},
                    {"There is a two blocks tower.", true},
                    {"There is a tower of three blocks that has a yellow top.", true},
                    {"The base of the tower with two blocks is blue.", true},
                    {"There is only one tower with a blue base.", true},
                    {"There is a tower with a black block and two blue blocks.", false},
                    {"All towers have a blue block.", false}});
}

TEST(Statements, SayHowHighTowersAreAndWhereTheyBeginAndEnd) {
  expect(towers(), {{"There is a tower of height three.", true},
                    {"There is only one tower that is exactly three blocks high.", true},
                    {"There is a tower with three or more blocks.", true},
                    {"There is a tower topped with a black block.", false},
                    {"There is one tower that starts with a blue block.", true},
                    {"There is a tower with a black base and a yellow top.", true},
                    {"The base of a tower is yellow.", true},
                    {"The top of at least two towers is blue.", false},
                    {"Two blue blocks are stacked on each other.", true},
                    {"Exactly two of the towers have the same height.", false}});
}

TEST(Statements, SayWhatIsInOneContainer) {
  expect(boxes(), {{"All yellow items are in one box.", false},
                   {"Exactly three items are inside one of the boxes.", true},
                   {"There is a black circle and a blue square in one box.", true},
                   {"All the items in one box are triangles.", true},
                   {"In one box there are only triangles.", true},
                   {"There is no blue circle in any of the boxes.", true},
                   {"There is no black circle in any of the boxes.", false},
                   {"The third box contains more items than the first box.", true},
                   {"The first box contains more items than the second box.", false},
                   {"One box has exactly three items, and the circle is black.", true},
                   {"There is a box with two items, the square is blue.", true}});
}

TEST(Statements, GoOnAboutAnIndefiniteThing) {
  expect(towers(), {{"There is a black block and a blue block on top of it.", true},
                    {"There is a black block and a yellow block on top of it.", false}});
}

TEST(Statements, SayWhatIsOnWhat) {
  expect(towers(), {{"There is a blue block on a black block.", true},
                    {"There is a yellow block above a black block.", false},
                    {"There is a tower with a yellow block over a different colored block.", true},
                    {"There is a black block as the base of a tower.", true},
                    {"There is a blue block between a black block and a yellow block.", true},
                    {"There is a tower with 2 blue blocks stacked together.", true},
                    {"There are exactly two towers with a yellow block at the top.", true}});
}

TEST(Statements, SayWhatTouchesWalls) {
  expect(boxes(), {{"There is a black circle touching the wall.", true},
                   {"There is exactly one circle not touching any edge.", true},
                   {"There is a blue square closely touching a corner.", true},
                   {"There is a yellow triangle touching the bottom of a box.", true},
                   {"There is a yellow triangle touching the top.", false},
                   {"The blue square is touching the left wall.", false},
                   {"There are two black circles touching an edge.", false},
                   {"The blue square is touching one of the sides.", true},
                   {"At least three yellow items do not touch the edge.", true},
                   {"Exactly one black circle is away from the edges.", true},
                   {"Only one color touches the bottom.", true}});
  EXPECT_EQ(judgement(towers(), "There is only one color touching the wall."), "false");
}

TEST(Statements, SayWhatSeveralThingsAreTogether) {
  expect(towers(), {{"There are two towers with the same height.", false},
                    {"There is a tower with two blocks of the same color.", true},
                    {"There is a tower with blocks of all three colors.", true},
                    {"There are two towers with only one color.", true}});
  expect(boxes(), {{"There is a box with items of only one color.", true},
                   {"All yellow items are in the same box.", false},
                   {"All triangles are in the same box.", true}});
}

TEST(Statements, GoOnAboutTheSameThing) {
  expect(towers(),
         {{"There is a tower with two blocks, and it has a blue base.", true},
          {"There is a tower with two blocks, and it has a black base.", false},
          {"There is a box with three items and the yellow one is on top.", true},
          {"There is a tower with more than one block where all the blocks are blue.", true},
          {"There is a tower with only one block which is black.", false}});
}

TEST(Statements, AreUnderstoodDespiteLostLetters) {
  expect(towers(), {{"ll towers have a blue block", false},
                    {"t least two towers ha a blue block", true},
                    {"There is atleast one blue block", true},
                    {"There is ablue block on a black block", true}});
}

TEST(Statements, AreContradictedWithAReason) {
  EXPECT_EQ(reply(towers(), "There are two black blocks."), "No, there is one black block.");
  EXPECT_EQ(reply(towers(), "There are two blue blocks."), "No, there are three blue blocks.");
  EXPECT_EQ(reply(boxes(), "There is a blue circle."), "I do not see a blue circle.");
}

TEST(Statements, AreContradictedByTheContainerThatIsOtherwise) {
  EXPECT_EQ(reply(boxes(), "Every box has two items."), "No, the third box has three objects.");
  EXPECT_EQ(reply(boxes(), "The second box has three triangles."),
            "No, the second box has two triangles.");
  EXPECT_EQ(reply(boxes(), "Each box has a black circle."),
            "No, the second box has no black circle.");
  EXPECT_EQ(reply(boxes(), "All boxes have only yellow items."),
            "No, the leftmost box has a black circle.");
  EXPECT_EQ(reply(towers(), "All towers have a blue block."),
            "No, the third tower has no blue block.");
}

TEST(Statements, AreContradictedByHowManyAreSo) {
  EXPECT_EQ(reply(towers(), "Two towers have a black block."), "No, one tower has a black block.");
  EXPECT_EQ(reply(towers(), "One of the towers has a blue block."),
            "No, two of the towers have a blue block.");
  EXPECT_EQ(reply(boxes(), "All yellow items are squares."),
            "No, two yellow objects are not squares.");
}

TEST(Statements, AreAcceptedIfTheyAreSoOfWhateverMayBeMeant) {
  EXPECT_EQ(judgement(towers(), "The blue block is in a tower."), "true");
  EXPECT_EQ(reply(towers(), "The blue block is at the base."), "Which blue block do you mean?");
}

} // namespace castor::communication::test
