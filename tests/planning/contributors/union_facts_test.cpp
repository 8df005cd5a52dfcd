#include "castor/planning/contributors/union_facts.hpp"

#include "castor/planning/continual/plan_continuation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::planning {

namespace {

using binding::feature;
using binding::FeatureKind;
using binding::KnownUnion;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

/// A red ball left of a box; the box may be blue, and is not green.
binding::ReferenceReply table() {
  binding::ReferenceReply result;
  result.unions = {
    KnownUnion{"union of ball",
               "vision/ball",
               {feature(FeatureKind::concept_name, "thing"), feature(FeatureKind::colour, "red"),
                feature(FeatureKind::shape, "unknown"), feature(FeatureKind::colour, "red")}},
    KnownUnion{"union of box",
               "vision/Box",
               {feature(FeatureKind::concept_name, "box"),
                binding::negation_of(feature(FeatureKind::colour, "green"))}},
    KnownUnion{"union of ball-place", "vision/at/ball", {}},
    KnownUnion{"union of box-place", "vision/at/Box", {}},
    KnownUnion{"union of nothing", "spatial/empty", {}},
    KnownUnion{"union of left", "spatial/left", {feature(FeatureKind::relation_label, "left")}}};
  result.relations = {{"left", "union of ball-place", "union of box-place"},
                      {"behind", "union of box-place", "union of ball-place"},
                      {"left", "union of nothing", "union of box-place"},
                      {"pos", "union of ball-place", "union of ball"},
                      {"pos", "union of box-place", "union of box"}};
  return result;
}

UnionFactTerms terms_of_tables() {
  UnionFactTerms result;
  result.relations = {{"left", "wp-left-of"}, {"right", "wp-right-of"}, {"near", "wp-near"}};
  return result;
}

TEST(UnionFacts, AreThingsTheirPlacesWordsAndRelations) {
  auto options = terms_of_tables();
  options.words = {word_facts("colour=has-colour:colour"), word_facts("shape=has-shape:shape"),
                   word_facts("concept=is-a:kind")};
  options.unknown = {{FeatureKind::shape, "no-shape"}, {FeatureKind::colour, "no-colour"}};
  options.free_places = 1;
  const auto told = facts_of(table(), options);
  EXPECT_THAT(
    told.objects,
    UnorderedElementsAre(StateObject{"vision/ball", "thing"}, StateObject{"vision/^.box", "thing"},
                         StateObject{"vision/at/ball", "waypoint"},
                         StateObject{"vision/at/^.box", "waypoint"},
                         StateObject{"free-place-1", "waypoint"}, StateObject{"red", "colour"},
                         StateObject{"thing", "kind"}, StateObject{"box", "kind"}));
  EXPECT_THAT(told.facts,
              UnorderedElementsAre("(has-colour vision/ball red)", "(no-shape vision/ball)",
                                   "(is-a vision/ball thing)", "(is-a vision/^.box box)",
                                   "(= (pos vision/ball) vision/at/ball)",
                                   "(= (pos vision/^.box) vision/at/^.box)",
                                   "(wp-left-of vision/at/ball vision/^.box)"));
}

TEST(UnionFacts, AreUnderstoodByThePlayMatesDomain) {
  std::ostringstream domain;
  domain << std::ifstream(CASTOR_DOMAINS "/playmate.pddl").rdbuf();
  auto options = terms_of_tables();
  options.free_places = 1;
  const auto told = facts_of(table(), options);
  FindPlan request;
  request.agent = "arm";
  request.objects = told.objects;
  request.objects.push_back({"arm", "agent"});
  request.facts = told.facts;
  request.goal = "(left-of vision/^.box vision/ball)";
  request.reason = PlanReason::no_plan_yet;
  const auto found = continue_plan({"playmate.pddl", domain.str()}, request, {});
  ASSERT_EQ(found.outcome, PlanOutcome::changed) << found.explanation;
  ASSERT_EQ(found.steps.size(), 2U);
  EXPECT_EQ(found.steps[0].action, "reposition-left arm free-place-1 vision/ball");
  EXPECT_EQ(found.steps[1].action, "move arm vision/^.box free-place-1");
  request.goal = "(left-of vision/ball vision/^.box)";
  EXPECT_EQ(continue_plan({"playmate.pddl", domain.str()}, request, {}).outcome,
            PlanOutcome::achieved);
}

TEST(UnionFacts, RefuseRulesThatTheyDoNotUnderstand) {
  EXPECT_THROW(word_facts("colour"), std::invalid_argument);
  EXPECT_THROW(word_facts("colour=has-colour"), std::invalid_argument);
  EXPECT_THROW(word_facts("colour=:colour"), std::invalid_argument);
  try {
    word_facts("smell=smells:smell");
    ADD_FAILURE();
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), HasSubstr("there is no feature 'smell'"));
  }
}

} // namespace

} // namespace castor::planning
