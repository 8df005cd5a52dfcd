#include "castor/base/ontology.hpp"

#include "castor/base/ontology_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

namespace {

Ontology ontology(const std::string& text) {
  const std::vector<NamedText> files{{"test.ontology", text}};
  const auto read = read_ontology(files);
  EXPECT_THAT(render(read.problems), IsEmpty());
  return Ontology{read.statements};
}

std::string problems(const std::vector<NamedText>& files) {
  const auto read = read_ontology(files);
  EXPECT_TRUE(read.problems.empty() || read.statements.empty());
  return render(read.problems);
}

std::string problems(const std::string& text) {
  return problems(std::vector<NamedText>{{"test.ontology", text}});
}

constexpr auto robots_world = R"(
concept thing place
concept room: place
concept kitchen office: room
concept ball: thing with shape sphere
concept cup mug plate: thing
concept toy: thing
concept toy_ball: toy, ball
disjoint thing place     # nothing is both
partition thing
partition room
alike cube square rectangle
)";

} // namespace

TEST(Ontology, KnowsWhatIsAKindOfWhat) {
  const auto x = ontology(robots_world);
  EXPECT_TRUE(x.is_kind_of("kitchen", "room"));
  EXPECT_TRUE(x.is_kind_of("kitchen", "place"));
  EXPECT_TRUE(x.is_kind_of("toy_ball", "thing"));
  EXPECT_TRUE(x.is_kind_of("kitchen", "kitchen"));
  EXPECT_FALSE(x.is_kind_of("room", "kitchen"));
  EXPECT_FALSE(x.is_kind_of("kitchen", "office"));
  EXPECT_FALSE(x.is_kind_of("kitchen", "thing"));
  EXPECT_THAT(x.parents("kitchen"), ElementsAre("room"));
  EXPECT_TRUE(x.has_kinds("room"));
  EXPECT_FALSE(x.has_kinds("kitchen"));
}

TEST(Ontology, SaysNothingOfWhatItDoesNotKnow) {
  const auto x = ontology(robots_world);
  EXPECT_FALSE(x.knows("aquarium"));
  EXPECT_FALSE(x.is_kind_of("aquarium", "thing"));
  EXPECT_FALSE(x.excludes("aquarium", "thing"));
  EXPECT_TRUE(x.is_kind_of("aquarium", "aquarium"));
  EXPECT_TRUE(Ontology{}.empty());
}

TEST(Ontology, InheritsDisjointness) {
  const auto x = ontology(robots_world);
  EXPECT_TRUE(x.excludes("thing", "place"));
  EXPECT_TRUE(x.excludes("ball", "kitchen"));
  EXPECT_TRUE(x.excludes("kitchen", "ball"));
  EXPECT_FALSE(x.excludes("kitchen", "room"));
  EXPECT_FALSE(x.excludes("kitchen", "kitchen"));
}

TEST(Ontology, SeparatesTheKindsOfAPartition) {
  const auto x = ontology(robots_world);
  EXPECT_TRUE(x.excludes("kitchen", "office"));
  EXPECT_TRUE(x.excludes("cup", "plate"));
  EXPECT_FALSE(x.excludes("ball", "toy")) << "a toy ball is both";
  EXPECT_TRUE(x.excludes("toy_ball", "cup"));
  EXPECT_FALSE(x.excludes("ball", "thing"));
  EXPECT_FALSE(ontology("concept a b: c\nconcept c").excludes("a", "b"));
}

TEST(Ontology, HasDefinitionsAndLikeness) {
  const auto x = ontology(robots_world);
  EXPECT_THAT(x.definition("ball"), ElementsAre(ConceptProperty{"shape", "sphere"}));
  EXPECT_THAT(x.definition("cup"), IsEmpty());
  EXPECT_TRUE(x.are_alike("cube", "square"));
  EXPECT_TRUE(x.are_alike("rectangle", "cube"));
  EXPECT_FALSE(x.are_alike("square", "rectangle"));
  EXPECT_FALSE(x.knows("cube")) << "a word for a shape is no concept";
}

TEST(Ontology, TakesStatementsInAnyOrder) {
  const auto x = ontology("concept kitchen: room\npartition room\nconcept office: room\n"
                          "concept room: place\nconcept place");
  EXPECT_TRUE(x.is_kind_of("kitchen", "place"));
  EXPECT_TRUE(x.excludes("kitchen", "office"));
}

TEST(Ontology, LeavesOutWhatContradictsTheRest) {
  std::vector<OntologyProblem> found;
  const Ontology x{{{.name = "thing"},
                    {.name = "place", .disjoint_with = {"thing"}},
                    {.name = "shed", .is_a = {"place"}},
                    {.name = "shed", .is_a = {"thing"}},
                    {.name = "barn", .is_a = {"building"}},
                    {.name = "barn", .is_a = {"place"}}},
                   &found};
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].statement, 3U);
  EXPECT_EQ(found[0].message,
            "\"shed\" is a kind of \"place\" and of \"thing\", which exclude each other");
  EXPECT_EQ(found[1].message, "\"building\" is no concept");
  EXPECT_TRUE(x.is_kind_of("shed", "place"));
  EXPECT_FALSE(x.is_kind_of("shed", "thing"));
  EXPECT_TRUE(x.is_kind_of("barn", "place"));
}

TEST(OntologyFile, ReportsUnknownConceptsWithSuggestions) {
  EXPECT_EQ(problems("concept kitchen: rom\nconcept room\n"),
            "test.ontology:1:18: error: \"rom\" is no concept\n"
            "    concept kitchen: rom\n"
            "                     ^\n"
            "  remedy: did you mean 'room'?\n");
  EXPECT_THAT(problems("concept thing place\ndisjoint thing palce"), HasSubstr("did you mean"));
  EXPECT_THAT(problems("partition vehicles"), HasSubstr("\"vehicles\" is no concept"));
}

TEST(OntologyFile, ReportsCyclesAndContradictions) {
  EXPECT_THAT(problems("concept a: b\nconcept b: c\nconcept c: a"),
              HasSubstr("test.ontology:3:12: error: cycle of kinds: c -> a -> b -> c"));
  EXPECT_THAT(problems("concept a: a"), HasSubstr("cycle of kinds: a -> a"));
  EXPECT_THAT(
    problems("concept thing place\ndisjoint thing place\nconcept room: thing, place"),
    HasSubstr("\"room\" is a kind of \"thing\" and of \"place\", which exclude each other"));
  EXPECT_THAT(problems("concept room: place\nconcept place\ndisjoint room place"),
              HasSubstr("\"room\" is a kind of \"place\", which excludes it"));
}

TEST(OntologyFile, ReportsWhatIsWrittenWrongly) {
  EXPECT_THAT(problems("concpt room"), HasSubstr("did you mean 'concept'?"));
  EXPECT_THAT(problems("concept"), HasSubstr("the line names no concept"));
  EXPECT_THAT(problems("concept room:"), HasSubstr("a kind is missing"));
  EXPECT_THAT(problems("concept room: place area"), HasSubstr("\"area\" does not follow a comma"));
  EXPECT_THAT(problems("concept ball: thing with shape"), HasSubstr("a property has no value"));
  EXPECT_THAT(problems("concept a\ndisjoint a"), HasSubstr("takes several concepts"));
  EXPECT_THAT(problems("concept a, b"), HasSubstr("Separate the concepts by blanks"));
}

TEST(OntologyFile, RefersToOtherFiles) {
  const std::vector<NamedText> files{{"robot.ontology", "concept pantry: room\n"},
                                     {"shared.ontology", "concept room: plac\nconcept place\n"}};
  EXPECT_THAT(problems(files), HasSubstr("shared.ontology:1:15: error: \"plac\" is no concept"));
  EXPECT_THAT(problems({files[0], {"shared.ontology", "concept room\n"}}), IsEmpty());
}

} // namespace castor
