#include "castor/benchmarks/semeval/robot_commands/grounding.hpp"

#include <gmock/gmock.h>

using namespace castor::semeval;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

namespace {

/// A red cube with a blue one and a green prism upon it in the back right corner; another red cube
/// on the front edge, and a green cube beside it, nearer to the left.
Board board() {
  return *parse_board("7 3 5 O\n0 0 0 R 1\n0 0 1 B 1\n0 0 2 G 2\n7 2 0 R 1\n7 4 0 G 1\n");
}

/// Where the blocks are that an entity may be, as "x y z".
std::vector<std::string> find(const Board& where, const std::string& entity) {
  const auto tree = parse_rcl(entity);
  std::vector<std::string> found;
  for (const auto& referent : Grounding(where, tree).referents(tree)) {
    if (referent.block == nullptr) {
      found.push_back("part");
      continue;
    }
    const auto& at = referent.block->position;
    found.push_back(std::to_string(at.x) + " " + std::to_string(at.y) + " " + std::to_string(at.z));
  }
  return found;
}

std::string related(const std::string& what, const std::string& relation,
                    const std::string& other) {
  return "(entity: " + what + " (spatial-relation: (relation: " + relation + ") (entity: " + other +
         ")))";
}

} // namespace

TEST(Board, IsReadFromItsLayout) {
  const auto read = board();
  EXPECT_THAT(read.blocks, SizeIs(5));
  EXPECT_EQ(read.height(0, 0), 3);
  EXPECT_EQ(read.height(7, 2), 1);
  EXPECT_EQ(read.height(3, 3), 0);
  EXPECT_EQ(read.at({0, 0, 2})->type, "prism");
  EXPECT_EQ(read.at({0, 0, 2})->color, "green");
  EXPECT_FALSE(read.held);
}

TEST(Board, KnowsWhatAClosedGripperHolds) {
  const auto read = parse_board("3 3 4 C\n3 3 4 Y 2\n0 0 0 R 1\n");
  ASSERT_TRUE(read);
  ASSERT_TRUE(read->held);
  EXPECT_EQ(read->held->color, "yellow");
  EXPECT_THAT(read->blocks, SizeIs(1));
}

TEST(Board, RefusesWhatIsNoLayout) {
  EXPECT_FALSE(parse_board("0 0 0 Q 1"));
  EXPECT_FALSE(parse_board("0 0 0 R 3"));
  EXPECT_FALSE(parse_board("0 8 0 R 1"));
  EXPECT_FALSE(parse_board("0 0 0 Z"));
  EXPECT_FALSE(parse_board("0 0"));
}

TEST(Grounding, FindsBlocksByTypeAndColour) {
  EXPECT_THAT(find(board(), "(entity: (color: red) (type: cube))"),
              UnorderedElementsAre("0 0 0", "7 2 0"));
  EXPECT_THAT(find(board(), "(entity: (type: prism))"), ElementsAre("0 0 2"));
  EXPECT_THAT(find(board(), "(entity: (color: white) (type: cube))"), IsEmpty());
}

TEST(Grounding, HeedsRelations) {
  const std::string green = "(color: green) (type: cube)";
  const std::string red = "(color: red) (type: cube)";
  EXPECT_THAT(find(board(), related("(type: cube)", "above", red)), ElementsAre("0 0 1"));
  EXPECT_THAT(find(board(), related("(type: prism)", "above", red)), IsEmpty());
  EXPECT_THAT(find(board(), related(red, "nearest", green)), ElementsAre("7 2 0"));
  EXPECT_THAT(find(board(), related(green, "left", red)), ElementsAre("7 4 0"));
  EXPECT_THAT(find(board(), related(green, "right", red)), IsEmpty());
  EXPECT_THAT(find(board(), related("(color: blue) (type: cube)", "left", green)), IsEmpty());
  EXPECT_THAT(find(board(), related("(color: blue) (type: cube)", "right", green)),
              ElementsAre("0 0 1"));
  EXPECT_THAT(find(board(), related(red, "within", "(indicator: back) (type: corner)")),
              ElementsAre("0 0 0"));
  EXPECT_THAT(find(board(), related(red, "within", "(indicator: left) (type: corner)")), IsEmpty());
  EXPECT_THAT(find(board(), related(red, "above", "(indicator: front) (type: edge)")),
              ElementsAre("7 2 0"));
}

TEST(Grounding, HeedsIndicators) {
  EXPECT_THAT(find(board(), "(entity: (indicator: individual) (color: red) (type: cube))"),
              ElementsAre("7 2 0"));
  EXPECT_THAT(find(board(), "(entity: (indicator: leftmost) (type: cube))"), ElementsAre("7 4 0"));
  EXPECT_THAT(find(board(), "(entity: (indicator: back) (color: red) (type: cube))"),
              ElementsAre("0 0 0"));
  EXPECT_THAT(find(board(), "(entity: (indicator: left) (indicator: front) (type: corner))"),
              SizeIs(1));
  EXPECT_THAT(find(board(), "(entity: (indicator: left) (type: corner))"), SizeIs(2));
}

TEST(Grounding, FindsStacksByAllTheirColours) {
  EXPECT_THAT(find(board(), "(entity: (color: red) (color: blue) (type: stack))"), SizeIs(1));
  EXPECT_THAT(find(board(), "(entity: (color: red) (type: stack))"), IsEmpty());
  EXPECT_THAT(find(board(), "(entity: (type: stack))"), SizeIs(1));
  EXPECT_THAT(find(board(), related("(type: prism)", "above",
                                    "(color: red) (color: blue) (type: cube-group)")),
              ElementsAre("0 0 2"));
}

TEST(Grounding, ResolvesReferences) {
  const auto command = parse_rcl(
    "(sequence: (event: (action: take) (entity: (id: 1) (type: prism))) (event: (action: drop) "
    "(entity: (type: reference) (reference-id: 1)) (destination: (spatial-relation: (relation: "
    "above) (entity: (color: red) (type: type-reference) (reference-id: 1))))))");
  const auto where = board();
  const Grounding grounding(where, command);
  const auto& second = command.children[1];
  EXPECT_THAT(grounding.referents(*second.child("entity")), SizeIs(1));
  const auto& place = *second.child("destination")->children[0].child("entity");
  EXPECT_THAT(grounding.referents(place), IsEmpty()) << "there is no red prism";
}

TEST(Grounding, EndsWhereAThingRefersToItself) {
  const auto command = parse_rcl(
    "(entity: (id: 1) (type: cube) (spatial-relation: (relation: above) (entity: (type: reference) "
    "(reference-id: 1))))");
  const auto where = board();
  EXPECT_THAT(Grounding(where, command).referents(command), IsEmpty());
}

TEST(Grounding, KnowsWhatNothingLiesUpon) {
  const auto where = board();
  const auto cubes = parse_rcl("(entity: (type: cube))");
  const Grounding grounding(where, cubes);
  int clear = 0;
  for (const auto& cube : grounding.referents(cubes))
    clear += grounding.is_clear(cube) ? 1 : 0;
  EXPECT_EQ(clear, 2);
}
