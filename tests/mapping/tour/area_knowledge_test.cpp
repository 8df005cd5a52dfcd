#include "castor/base/ontology_reader.hpp"
#include "castor/base/text_file.hpp"
#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/mapping/tour/area_knowledge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

using binding::UnionRelation;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Area area(std::int64_t id, const std::string& label = {}, std::int64_t merged_into = -1) {
  Area result;
  result.id = id;
  result.label = label;
  result.merged_into = merged_into;
  return result;
}

GraphNode place_of_area(std::int64_t id, std::int64_t area) {
  GraphNode result;
  result.id = id;
  result.area = area;
  return result;
}

GraphNode door(std::int64_t id) {
  GraphNode result;
  result.id = id;
  result.kind = NodeKind::gateway;
  return result;
}

std::vector<std::string> concepts_of(const binding::KnowledgeReply& told, const std::string& id) {
  std::vector<std::string> result;
  for (auto& x : told.things)
    if (x.id == id)
      for (auto& feature : x.features)
        result.push_back(feature.text);
  return result;
}

TEST(AreaKnowledge, IsOfRoomsTheirNamesAndWhereTheRobotIs) {
  const std::vector<GraphNode> nodes{place_of_area(1, 0), door(2), place_of_area(3, 4), place_of_area(4, 6)};
  const std::vector<GraphEdge> edges{{1, 2, 1}, {2, 3, 1}};
  const auto told =
    knowledge_of_areas({area(0), area(4, "living room"), area(5, "office", 4), area(6)}, nodes,
                       edges, 4);
  EXPECT_EQ(told.things.size(), 4U);
  EXPECT_THAT(concepts_of(told, "area-0"), UnorderedElementsAre("room"));
  EXPECT_THAT(concepts_of(told, "area-4"), UnorderedElementsAre("room", "living_room"));
  EXPECT_THAT(concepts_of(told, "self"), UnorderedElementsAre("self"));
  EXPECT_THAT(told.relations, UnorderedElementsAre(UnionRelation{"in", "self", "area-4"},
                                                   UnionRelation{"near", "area-0", "area-4"},
                                                   UnionRelation{"near", "area-4", "area-0"}));
}

TEST(AreaKnowledge, SaysNothingOfWhereARobotIsThatIsLostOrInAnAreaThatIsGone) {
  EXPECT_THAT(knowledge_of_areas({area(0)}, {place_of_area(1, 0)}, {}, std::nullopt).relations, IsEmpty());
  EXPECT_THAT(knowledge_of_areas({area(0), area(3, "", 0)}, {place_of_area(1, 0)}, {}, 3).relations,
              IsEmpty());
}

TEST(AreaKnowledge, RepliesToNames) {
  EXPECT_EQ(reply_to_name("kitchen", ""), "Ok, this is the kitchen.");
  EXPECT_EQ(reply_to_name("kitchen", "office"), "Ok, this is the kitchen, and not the office.");
  EXPECT_EQ(reply_to_name("kitchen", "kitchen"), "Yes, this is the kitchen.");
  EXPECT_EQ(reply_to_name("kitchen", std::nullopt),
            "Ok, I will call it the kitchen when I have come there.");
}

TEST(AreaKnowledge, HasConceptsForAllWordsForRooms) {
  const std::string folder{CASTOR_CONFIGS "/language/"};
  std::vector<NamedText> files{binding::shared_ontology_files().front(),
                               {"rooms.ontology", load_text(folder + "rooms.ontology")}};
  const auto stated = read_ontology(files);
  EXPECT_EQ(render(stated.problems), "");
  const communication::Vocabulary vocabulary{
    communication::lexicon_of_files("english.ccg language/rooms.words", CASTOR_CONFIGS),
    std::make_shared<const Ontology>(stated.statements)};
  std::istringstream words{load_text(folder + "rooms.words")};
  int nouns = 0;
  for (std::string line; std::getline(words, line) && !line.starts_with("words ");)
    if (line.starts_with("  "))
      for (auto [noun, rest] = std::pair{std::string{}, std::istringstream{line}}; rest >> noun;) {
        EXPECT_TRUE(vocabulary.ontology().is_kind_of(vocabulary.concept_of(noun), "place")) << noun;
        EXPECT_EQ(concept_of_label(label_of_concept(noun)), noun);
        ++nouns;
      }
  EXPECT_GT(nouns, 40);
}

} // namespace

} // namespace castor::mapping::test
