#include "castor/planning/contributors/graph_facts.hpp"

#include "castor/planning/continual/object_name.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace castor::planning {

namespace {

using mapping::GraphEdge;
using mapping::GraphNode;
using mapping::NodeKind;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

GraphNode node(std::int64_t id, std::int64_t area) {
  GraphNode result;
  result.id = id;
  result.area = area;
  result.kind = area < 0 ? NodeKind::gateway : NodeKind::place;
  return result;
}

mapping::Area area(std::int64_t id, const std::string& label = "", std::int64_t merged_into = -1) {
  mapping::Area result;
  result.id = id;
  result.label = label;
  result.merged_into = merged_into;
  return result;
}

/// A hall, an office behind the door 2, and a door 5 through which nobody has gone.
GraphEntries hall_and_office() {
  GraphEntries result;
  result.nodes = {node(1, 0), node(2, -1), node(3, 4), node(4, 4), node(5, -1)};
  result.edges = {GraphEdge{1, 2, 1}, GraphEdge{2, 3, 1}, GraphEdge{3, 4, 1}, GraphEdge{4, 5, 1}};
  result.areas = {area(0, "Hall"), area(4, "Ann's office"), area(7, "", 4)};
  result.robot = mapping::RobotArea{1, 0, 9};
  return result;
}

GraphFactTerms terms_of_graphs() {
  GraphFactTerms result;
  result.agent = "robby";
  return result;
}

TEST(GraphFacts, AreAreasLabelsWaysAndTheRobotsPlace) {
  const auto told = facts_of(hall_and_office(), terms_of_graphs());
  EXPECT_THAT(told.objects,
              UnorderedElementsAre(StateObject{"robby", "robot"}, StateObject{"area-0", "room"},
                                   StateObject{"area-4", "room"}, StateObject{"hall", "area-name"},
                                   StateObject{"ann^27s-office", "area-name"}));
  EXPECT_THAT(told.facts,
              UnorderedElementsAre("(= (is-in robby) area-0)", "(= (area-of hall) area-0)",
                                   "(= (area-of ann^27s-office) area-4)",
                                   "(connected area-0 area-4)", "(connected area-4 area-0)"));
}

TEST(GraphFacts, DoNotSayWhichOfTwoAreasOfOneNameIsMeant) {
  auto graph = hall_and_office();
  graph.areas = {area(0, "office"), area(4, "Office ")};
  const auto told = facts_of(graph, terms_of_graphs());
  EXPECT_THAT(told.objects, testing::Contains(StateObject{"office", "area-name"}));
  for (const auto& x : told.facts)
    EXPECT_EQ(x.find("area-of"), std::string::npos) << x;
}

TEST(GraphFacts, DoNotSayWhereTheRobotIsBeforeThatIsKnown) {
  const auto told = facts_of(GraphEntries{}, terms_of_graphs());
  EXPECT_THAT(told.objects, UnorderedElementsAre(StateObject{"robby", "robot"}));
  EXPECT_THAT(told.facts, IsEmpty());
}

TEST(ObjectName, DiffersForDifferentIds) {
  EXPECT_EQ(object_name("vision/object/3"), "vision/object/3");
  EXPECT_EQ(object_name("aB"), "a^.b");
  EXPECT_NE(object_name("aB"), object_name("ab"));
  EXPECT_EQ(object_name("a b"), "a^20b");
  EXPECT_EQ(object_name("?x"), "^3fx");
  EXPECT_EQ(object_name(""), "^");
  EXPECT_EQ(word_name(" Living Room"), "living-room");
}

} // namespace

} // namespace castor::planning
