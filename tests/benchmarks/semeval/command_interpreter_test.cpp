#include "castor/benchmarks/semeval/robot_commands/command_interpreter.hpp"
#include "castor/benchmarks/semeval/robot_commands/command_words.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

using namespace castor::semeval;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

CommandInterpreter& interpreter() {
  static auto shipped = robot_command_interpreter();
  return shipped;
}

std::string understand(const std::string& command, const Board* board = nullptr) {
  const auto readings = interpreter().interpret(command, board);
  return readings.empty() ? "nothing" : to_string(readings.front().tree);
}

Board layout(const std::string& text) {
  return *parse_board(text);
}

std::string cube(const std::string& color, const std::string& relation = "") {
  return "(entity: (color: " + color + ") (type: cube)" + (relation.empty() ? "" : " " + relation) +
         ")";
}

std::string above(const std::string& entity) {
  return "(spatial-relation: (relation: above) " + entity + ")";
}

std::string event(const std::string& action, const std::string& entity,
                  const std::string& relation) {
  return "(event: (action: " + action + ") " + entity + " (destination: " + relation + "))";
}

} // namespace

TEST(CommandWords, AreTokensAsAnnotationsCountThem) {
  EXPECT_THAT(command_tokens("Pick up  the red-green block, now."),
              ElementsAre("pick", "up", "the", "red", "-", "green", "block", ",", "now", "."));
  EXPECT_THAT(command_tokens(""), IsEmpty());
}

TEST(CommandInterpreter, UnderstandsASingleAction) {
  EXPECT_EQ(understand("pick up the green pyramid"),
            "(event: (action: take) (entity: (color: green) (type: prism)))");
}

TEST(CommandInterpreter, UnderstandsMoves) {
  EXPECT_EQ(understand("Move the red cube on top of the blue cube."),
            event("move", cube("red"), above(cube("blue"))));
  EXPECT_EQ(understand("move the yellow block three squares to the left"),
            event("move", cube("yellow"),
                  "(spatial-relation: (measure: (entity: (cardinal: 3) (type: tile))) (relation: "
                  "left))"));
}

TEST(CommandInterpreter, UnderstandsTakingAndDroppingOneThing) {
  EXPECT_EQ(
    understand("take the white block and put it in the front left corner"),
    "(sequence: (event: (action: take) (entity: (id: 1) (color: white) (type: cube))) (event: "
    "(action: drop) (entity: (type: reference) (reference-id: 1)) (destination: "
    "(spatial-relation: (relation: within) (entity: (indicator: front) (indicator: left) "
    "(type: corner))))))");
}

TEST(CommandInterpreter, KnowsWhatOneRefersTo) {
  EXPECT_EQ(understand("put the red block on the yellow one"),
            event("move", "(entity: (id: 1) (color: red) (type: cube))",
                  above("(entity: (color: yellow) (type: type-reference) (reference-id: 1))")));
}

TEST(CommandInterpreter, ForgivesSpellingMistakes) {
  EXPECT_EQ(understand("pikc up the gren pyramyd"), understand("pick up the green pyramid"));
}

TEST(CommandInterpreter, LeavesOutWordsThatItDoesNotKnow) {
  EXPECT_EQ(understand("pick up the wonderfully xyzzy green pyramid"),
            understand("pick up the green pyramid"));
}

TEST(CommandInterpreter, UnderstandsNothingOfNonsense) {
  EXPECT_EQ(understand(""), "nothing");
  EXPECT_EQ(understand("qqqq wwww zzzz"), "nothing");
}

TEST(CommandInterpreter, DropsWhatIsHeldAndMovesWhatIsNot) {
  const auto holding = layout("1 1 3 C\n1 1 3 R 1\n4 4 0 B 1\n");
  const auto standing = layout("7 1 3 O\n1 1 0 R 1\n4 4 0 B 1\n");
  const std::string command = "place the red block on the blue block";
  EXPECT_EQ(understand(command, &holding), event("drop", cube("red"), above(cube("blue"))));
  EXPECT_EQ(understand(command, &standing), event("move", cube("red"), above(cube("blue"))));
}

TEST(CommandInterpreter, AttachesAsTheBoardHasIt) {
  const std::string command = "move the red cube on the blue cube on the green cube";
  const auto red_on_blue = layout("7 1 5 O\n1 1 0 B 1\n1 1 1 R 1\n4 4 0 G 1\n6 2 0 R 1\n");
  const auto blue_on_green = layout("7 1 5 O\n1 1 0 R 1\n4 4 0 G 1\n4 4 1 B 1\n6 2 0 B 1\n");
  EXPECT_EQ(understand(command, &red_on_blue),
            event("move", cube("red", above(cube("blue"))), above(cube("green"))));
  EXPECT_EQ(understand(command, &blue_on_green),
            event("move", cube("red"), above(cube("blue", above(cube("green"))))));
}

TEST(CommandWeights, AreReadAsTheyAreWritten) {
  const std::string text = "a:b 1.50 -2.00\nc 0.25 0.00\n";
  EXPECT_EQ(to_string(parse_command_weights("# a comment\n\n" + text)), text);
  EXPECT_THROW(parse_command_weights("a:b 1.5"), std::runtime_error);
}

RC_GTEST_PROP(CommandInterpreter, SurvivesAnything, ()) {
  static const std::vector<std::string> words = {
    "pick", "up", "the", "red",     "blue",   "cube", "on", "top", "of",  "and", "it", "move",
    "left", "to", "two", "squares", "corner", "in",   ",",  ".",   "one", "zzz", "-",  "place"};
  static const auto board = layout("7 1 3 O\n1 1 0 R 1\n4 4 0 B 1\n4 4 1 R 1\n");
  const auto picks = *rc::gen::resize(16, rc::gen::container<std::vector<std::size_t>>(
                                            rc::gen::inRange<std::size_t>(0, words.size())));
  std::string text;
  for (const auto i : picks)
    text += words[i] + " ";
  const auto readings = interpreter().interpret(text, &board);
  for (std::size_t i = 1; i < readings.size(); ++i)
    RC_ASSERT(readings[i - 1].score >= readings[i].score);
  for (const auto& reading : readings)
    RC_ASSERT(to_string(parse_rcl(to_string(reading.tree))) == to_string(reading.tree));
}
