#include "castor/binding/ontology/stated_ontology.hpp"

#include "castor/binding/known_scene.hpp"
#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/tests/binding/proxies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace castor::binding::test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

namespace {

ConceptStatements said_by(std::string source, std::vector<ConceptStatement> statements) {
  return {std::move(source), std::move(statements)};
}

} // namespace

TEST(StatedOntology, IsTheSharedOneWithoutStatements) {
  const auto stated = stated_ontology({});
  EXPECT_TRUE(stated.ontology->is_kind_of("kitchen", "room"));
  EXPECT_TRUE(stated.ontology->excludes("ball", "kitchen"));
  EXPECT_NE(stated.version, 0U);
  EXPECT_THAT(stated.problems, IsEmpty());
}

TEST(StatedOntology, IsWhatAllEntriesState) {
  const auto files = said_by("files", {{.name = "room"}, {.name = "kitchen", .is_a = {"room"}}});
  const auto robot = said_by("robot", {{.name = "studio", .is_a = {"room"}}});
  const auto stated = stated_ontology({{"b", files}, {"a", robot}});
  EXPECT_TRUE(stated.ontology->is_kind_of("studio", "room"));
  EXPECT_TRUE(stated.ontology->is_kind_of("kitchen", "room"));
  EXPECT_FALSE(stated.ontology->knows("thing"));
  EXPECT_NE(stated.version, stated_ontology({{"b", files}}).version);
  EXPECT_EQ(stated.version, stated_ontology({{"a", robot}, {"b", files}}).version);
}

TEST(StatedOntology, SaysWhatItLeavesOut) {
  const auto stated =
    stated_ontology({{"1", said_by("files", {{.name = "room"}})},
                     {"2", said_by("somebody", {{.name = "studio", .is_a = {"rom"}}})}});
  ASSERT_THAT(stated.problems, SizeIs(1));
  EXPECT_EQ(stated.problems.front(),
            "somebody states of \"studio\" what is left out: \"rom\" is no concept (did you mean "
            "'room'?)");
}

TEST(KnownScene, HasWhatSomebodySaysWhenAsked) {
  BindingView view;
  auto ball = proxy_from("vision", {concept_of("thing"), frame("perceived")});
  BindingUnion bound;
  bound.proxy_ids = {"vision/ball"};
  bound.features = ball.features;
  view.set("vision/ball", std::make_shared<const BindingProxy>(ball));
  view.set("union of vision/ball", std::make_shared<const BindingUnion>(bound));
  BindingUnion wished;
  wished.features = {concept_of("thing"), frame("desired")};
  view.set("wish", std::make_shared<const BindingUnion>(wished));
  auto scene = perceived(view);
  ASSERT_THAT(scene.unions, SizeIs(1));
  scene.add({"rooms", "room", true},
            {{{"kitchen", {}, {concept_of("kitchen")}}, {"ball", "vision/ball", {colour("red")}}},
             {{"in", "vision/ball", "kitchen"}}});
  ASSERT_THAT(scene.unions, SizeIs(2));
  EXPECT_THAT(scene.unions.at("rooms/kitchen").features, ElementsAre(concept_of("kitchen")));
  EXPECT_THAT(scene.unions.at("rooms/kitchen").proxy_ids, ElementsAre("rooms/kitchen"));
  EXPECT_EQ(scene.unions.at("union of vision/ball").features.back(), colour("red"));
  EXPECT_THAT(scene.relations,
              ElementsAre(UnionRelation{"in", "union of vision/ball", "rooms/kitchen"}));
}

} // namespace castor::binding::test
