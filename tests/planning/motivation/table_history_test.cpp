#include "castor/planning/motivation/table_goals.hpp"
#include "castor/planning/motivation/table_history.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace castor::planning;

namespace {

const std::vector<TableThing> table{{"p/a", "a", "at-a", "the red ball"},
                                    {"p/b", "b", "at-b", "the blue ball"},
                                    {"p/c", "c", "at-c", "the red box"}};

std::string answer(const std::string& action, const TableHistory& history,
                   const std::vector<std::string>& things = {}) {
  return answer_about_history({action, things, 0, {}, {}}, table, history).words;
}

std::vector<std::string> things_named(const std::string& action, const TableHistory& history) {
  return answer_about_history({action, {}, 0, {}, {}}, table, history).things;
}

const TableMove ball{"a", "the red ball"};
const TableMove box{"c", "the red box"};
/// It is not on the table any more.
const TableMove disc{"d", "the disc"};
const TableHistory three{3, {ball, disc, ball}};

} // namespace

TEST(TableHistory, IsAskedByQuestions) {
  for (const auto* action : {"WhichMoved", "NotMoved", "LastMoved", "FirstMoved", "HowManyMoves",
                             "MovesInOrder", "MovedForThat", "StartedWith", "DoneWith"}) {
    EXPECT_TRUE(asks_about_history(action));
    EXPECT_TRUE(is_question(action));
  }
  EXPECT_FALSE(asks_about_history("WhereWas"));
}

TEST(TableHistory, TellsWhichThingsItNames) {
  EXPECT_EQ(things_named("WhichMoved", three), std::vector<std::string>{"p/a"});
  EXPECT_EQ(things_named("NotMoved", three), (std::vector<std::string>{"p/b", "p/c"}));
}

TEST(TableHistory, SaysWhatWasMoved) {
  EXPECT_EQ(answer("WhichMoved", {}), "I have moved nothing.");
  EXPECT_EQ(answer("WhichMoved", {1, {box}}), "I have moved the red box.");
  EXPECT_EQ(answer("WhichMoved", three), "I have moved two things: the red ball and the disc.");
  EXPECT_EQ(answer("WhichMoved", three, {"p/c"}), "I have moved nothing.");
}

TEST(TableHistory, SaysWhatWasNotMoved) {
  EXPECT_EQ(answer("NotMoved", three), "I have not moved the blue ball and the red box.");
  EXPECT_EQ(answer("NotMoved", three, {"p/a", "p/b"}), "I have not moved the blue ball.");
  EXPECT_EQ(answer("NotMoved", three, {"p/a"}), "I have moved all of them.");
}

TEST(TableHistory, SaysWhatWasFirstAndLast) {
  EXPECT_EQ(answer("FirstMoved", {}), "I have moved nothing.");
  EXPECT_EQ(answer("FirstMoved", three), "The first thing that I moved is the red ball.");
  EXPECT_EQ(answer("LastMoved", {2, {box, disc}}), "The last thing that I moved is the disc.");
  EXPECT_EQ(answer("FirstMoved", {90, {box, disc}}),
            "I do not remember what I moved first: that is too long ago.");
}

TEST(TableHistory, SaysWhatTheLastMovesWereMadeFor) {
  const TableMove before{"a", "the red ball", "you said 'clear the front'"};
  const TableMove first{"c", "the red box", "you said 'swap them'"};
  const TableMove second{"b", "the blue ball", "you said 'swap them'"};
  EXPECT_EQ(answer("LastMoved", {3, {before, first, second}}),
            "The last thing that I moved is the blue ball: you said 'swap them'.");
  EXPECT_EQ(answer("MovedForThat", {3, {before, first, second}}),
            "I have moved two things: the red box and the blue ball.");
  EXPECT_EQ(answer("MovedForThat", {1, {before}}), "I have moved the red ball.");
  EXPECT_EQ(answer("MovedForThat", {}), "I have moved nothing.");
}

TEST(TableHistory, SaysInWhichOrderAndHowOften) {
  EXPECT_EQ(answer("MovesInOrder", {1, {ball}}), "I have moved the red ball.");
  EXPECT_EQ(answer("MovesInOrder", {2, {box, disc}}),
            "I have moved the red box and then the disc.");
  EXPECT_EQ(answer("MovesInOrder", three),
            "I have moved the red ball, then the disc, and then the red ball again.");
  EXPECT_EQ(answer("HowManyMoves", {1, {ball}}), "I have made one move: the red ball.");
  EXPECT_EQ(answer("HowManyMoves", {90, {box, disc}}),
            "I have made 90 moves: last the red box and then the disc.");
  EXPECT_EQ(answer("HowManyMoves", three, {"p/a"}),
            "I have made two moves: the red ball and then the red ball again.");
}

TEST(TableHistory, SaysWhatTheLastRequestBeganWith) {
  const TableHistory both{3,
                          {{"c", "the red box", "before"},
                           {"b", "the blue ball", "that"},
                           {"a", "the red ball", "that"}}};
  EXPECT_EQ(answer("StartedWith", both, {"p/b"}), "Yes.");
  EXPECT_EQ(answer("StartedWith", both, {"p/a"}), "No, I moved the blue ball first.");
  EXPECT_EQ(answer("StartedWith", {1, {ball}}, {"p/c"}), "No, I moved the red ball first.");
  EXPECT_EQ(answer("StartedWith", {}, {"p/c"}), "I have moved nothing.");
}

TEST(TableHistory, SaysWhatWasDoneWithAThing) {
  const TableHistory moved{2, {{"a", "the red ball", "you said 'there'"}, ball, box}};
  EXPECT_EQ(answer("DoneWith", moved, {"p/a"}), "I moved the red ball.");
  EXPECT_EQ(answer("DoneWith", {1, {{"a", "the red ball", "you said 'there'"}}}, {"p/a"}),
            "I moved the red ball: you said 'there'.");
  EXPECT_EQ(answer("DoneWith", moved, {"p/b"}), "Nothing: I have not moved the blue ball.");
  EXPECT_EQ(answer("DoneWith", moved, {"p/b", "p/c"}),
            "I have not moved the blue ball. I moved the red box.");
}
