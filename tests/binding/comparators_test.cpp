#include "castor/binding/comparators.hpp"

#include "castor/binding/feature_comparator.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/tests/binding/proxies.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <vector>

namespace castor::binding::test {

namespace {

using enum FeatureKind;

/// In both orders.
Truth compare_both(const Feature& a, const Feature& b, const ComparatorOptions& options = {}) {
  const Truth result = compare(a, b, options);
  EXPECT_EQ(compare(b, a, options), result) << to_string(a) << ", " << to_string(b);
  return result;
}

TEST(Comparators, CompareWords) {
  for (auto kind : {name, relation_label, colour, shape, size, material, area_id, person_id}) {
    EXPECT_EQ(compare_both(feature(kind, "a"), feature(kind, "a")), Truth::yes);
    EXPECT_EQ(compare_both(feature(kind, "a"), feature(kind, "b")), Truth::no);
    EXPECT_EQ(compare_both(feature(kind, "unknown"), feature(kind, "a")), Truth::unknown);
    EXPECT_EQ(compare_both(feature(kind, ""), feature(kind, "")), Truth::unknown);
  }
  EXPECT_EQ(compare_both(feature(colour, "round"), feature(shape, "round")), Truth::unknown);
}

TEST(Comparators, KnowWhatAThingIs) {
  EXPECT_EQ(compare_both(concept_of("thing"), concept_of("ball")), Truth::yes);
  EXPECT_EQ(compare_both(concept_of("ball"), concept_of("ball")), Truth::yes);
  EXPECT_EQ(compare_both(concept_of("ball"), concept_of("box")), Truth::no);
  EXPECT_EQ(compare_both(concept_of("thing"), concept_of("room")), Truth::no);
  EXPECT_EQ(compare_both(concept_of("kitchen"), concept_of("thing")), Truth::no);
  EXPECT_EQ(compare_both(concept_of("kitchen"), concept_of("room")), Truth::yes);
  EXPECT_EQ(compare_both(concept_of("kitchen"), concept_of("office")), Truth::no);
}

TEST(Comparators, CompareConceptsByTheOntology) {
  ComparatorOptions options;
  options.ontology = std::make_shared<const Ontology>(
    std::vector<ConceptStatement>{{.name = "plant"},
                                  {.name = "rose", .is_a = {"plant"}},
                                  {.name = "fern", .is_a = {"plant"}},
                                  {.name = "bed", .disjoint_with = {"plant"}},
                                  {.name = "sphere", .alike = {"egg"}}});
  EXPECT_EQ(compare_both(concept_of("rose"), concept_of("plant"), options), Truth::yes);
  EXPECT_EQ(compare_both(concept_of("rose"), concept_of("bed"), options), Truth::no);
  // A rose that is a fern is not ruled out by anybody.
  EXPECT_EQ(compare_both(concept_of("rose"), concept_of("fern"), options), Truth::unknown);
  EXPECT_EQ(compare_both(negation_of(concept_of("bed")), concept_of("rose"), options), Truth::yes);
  EXPECT_EQ(compare_both(negation_of(concept_of("fern")), concept_of("rose"), options),
            Truth::unknown);
  EXPECT_EQ(compare_both(feature(shape, "egg"), feature(shape, "sphere"), options), Truth::unknown);
  EXPECT_FALSE(is_more_general(concept_of("rose"), concept_of("plant"), options));
  EXPECT_TRUE(is_more_general(concept_of("plant"), concept_of("rose"), options));
}

TEST(Comparators, DoNotTakeUnknownConceptsForThings) {
  EXPECT_EQ(compare_both(concept_of("aquarium"), concept_of("thing")), Truth::unknown);
  EXPECT_EQ(compare_both(concept_of("aquarium"), concept_of("room")), Truth::unknown);
  EXPECT_EQ(compare_both(concept_of("aquarium"), concept_of("aquarium")), Truth::yes);
}

TEST(Comparators, ComparePlacesByDistance) {
  EXPECT_EQ(compare_both(location_at(0, 0, 0, "table"), location_at(0.03, 0, 0.04, "table")),
            Truth::yes);
  EXPECT_EQ(compare_both(location_at(0, 0, 0, "table"), location_at(0.07, 0, 0, "table")),
            Truth::unknown);
  EXPECT_EQ(compare_both(location_at(0, 0, 0, "table"), location_at(0.06, 0, 0.08, "table")),
            Truth::no);
}

TEST(Comparators, PlacesInFramesThatNobodyRelatesAreUnknown) {
  EXPECT_EQ(compare_both(location_at(0, 0, 0, "table"), location_at(0, 0, 0, "base")),
            Truth::unknown);
  EXPECT_EQ(compare_both(location_at(0, 0, 0, "table"), location_at(9, 0, 0, "base")),
            Truth::unknown);
  EXPECT_EQ(compare_both(location_at(0, 0, 0, ""), location_at(0, 0, 0, "")), Truth::unknown);
  EXPECT_EQ(compare_both(location_at(0, 0, 0, ""), location_at(0, 0, 0, "table")), Truth::unknown);
}

TEST(Comparators, PlacesInRelatedFramesAreComparedInOne) {
  // The robot stands one metre before the table and looks along y; x is forward for it.
  geometry::FrameTree frames;
  frames.add({"base", {{0, -1, 0}, geometry::rotation_about_z(std::numbers::pi / 2), "table"}, 7});
  ComparatorOptions options;
  options.frames = &frames;
  const auto on_table = location_at(0.2, 0.1, 0.03, "table");
  EXPECT_EQ(compare_both(on_table, location_at(1.1, -0.2, 0.03, "base"), options), Truth::yes);
  EXPECT_EQ(compare_both(on_table, location_at(1.1, -0.13, 0.03, "base"), options), Truth::unknown);
  EXPECT_EQ(compare_both(on_table, location_at(1.1, 0.2, 0.03, "base"), options), Truth::no);
  EXPECT_EQ(compare_both(on_table, negation_of(location_at(1.1, -0.2, 0.03, "base")), options),
            Truth::no);
  EXPECT_EQ(compare_both(on_table, location_at(1.1, -0.2, 0.03, "map"), options), Truth::unknown);
}

TEST(Comparators, TimeFramesSourcesAndGroupsOnlyExclude) {
  EXPECT_EQ(compare_both(frame("perceived"), frame("perceived")), Truth::unknown);
  EXPECT_EQ(compare_both(frame("perceived"), frame("desired")), Truth::no);
  EXPECT_EQ(compare_both(not_from("vision"), feature(source_id, "vision")), Truth::no);
  EXPECT_EQ(compare_both(not_from("vision"), feature(source_id, "comsys")), Truth::unknown);
  EXPECT_EQ(compare_both(not_from("vision"), not_from("vision")), Truth::unknown);
  EXPECT_EQ(compare_both(feature(group, ""), feature(singular, "")), Truth::no);
  EXPECT_EQ(compare_both(feature(this_proxy_id, "p"), feature(existing_proxy_id, "p")), Truth::yes);
  EXPECT_EQ(compare_both(feature(this_proxy_id, "p"), feature(existing_proxy_id, "q")),
            Truth::unknown);
  for (auto kind : {temporal_frame, source_id, other_source_id, group, singular, salience})
    EXPECT_FALSE(is_evidence(kind, kind));
}

TEST(Comparators, KnowWhatIsDenied) {
  const auto red = test::colour("red");
  const auto blue = test::colour("blue");
  EXPECT_EQ(compare_both(negation_of(red), red), Truth::no);
  EXPECT_EQ(compare_both(negation_of(red), blue), Truth::yes);
  EXPECT_EQ(compare_both(negation_of(red), negation_of(red)), Truth::unknown);
  EXPECT_EQ(compare_both(negation_of(red), test::colour("unknown")), Truth::unknown);
  EXPECT_EQ(compare_both(negation_of(concept_of("thing")), concept_of("ball")), Truth::no);
  EXPECT_EQ(compare_both(negation_of(concept_of("ball")), concept_of("thing")), Truth::unknown);
  EXPECT_EQ(compare_both(negation_of(concept_of("ball")), concept_of("box")), Truth::yes);
}

TEST(FeatureComparator, AsksOthersAsFarAsItIsNotTrusted) {
  const auto ball = concept_of("ball");
  const auto toy = concept_of("toy");
  const auto thing = concept_of("thing");
  FeatureComparisonCompetence coma;
  coma.subarchitecture = "coma";
  for (auto trust : {Trust::completely, Trust::until_validated, Trust::not_at_all}) {
    coma.trust_no = trust;
    FeatureComparator comparator;
    comparator.add(coma);
    EXPECT_EQ(comparator.compare(ball, toy),
              trust == Trust::not_at_all ? Truth::unknown : Truth::no);
    EXPECT_EQ(comparator.competent_for(ball, toy) != nullptr, trust != Trust::completely);
    EXPECT_EQ(comparator.competent_for(ball, thing), nullptr);
    EXPECT_EQ(comparator.competent_for(test::colour("red"), test::colour("blue")), nullptr);
    comparator.answer(toy, ball, Truth::yes);
    EXPECT_EQ(comparator.compare(ball, toy), trust == Trust::completely ? Truth::no : Truth::yes);
    EXPECT_EQ(comparator.competent_for(ball, toy), nullptr);
    comparator.remove("coma");
    EXPECT_EQ(comparator.compare(ball, toy), Truth::no);
  }
}

TEST(FeatureComparator, ConfirmsWhatIsSaidInFull) {
  const FeatureComparator comparator;
  EXPECT_TRUE(comparator.confirms(concept_of("ball"), concept_of("thing")));
  EXPECT_TRUE(comparator.confirms(concept_of("ball"), concept_of("ball")));
  EXPECT_FALSE(comparator.confirms(concept_of("thing"), concept_of("ball")));
  EXPECT_FALSE(comparator.confirms(concept_of("box"), concept_of("ball")));
  EXPECT_TRUE(comparator.confirms(concept_of("box"), negation_of(concept_of("ball"))));
  EXPECT_FALSE(comparator.confirms(negation_of(concept_of("ball")), concept_of("box")));
  EXPECT_TRUE(comparator.confirms(test::colour("blue"), negation_of(test::colour("red"))));
}

TEST(FeatureComparator, LetsOthersCompareKindsThatItCannot) {
  FeatureComparator comparator;
  const auto here = feature(area_id, "7");
  const auto kitchen = concept_of("kitchen");
  EXPECT_FALSE(comparator.is_evidence(area_id, concept_name));
  comparator.add({"coma", area_id, concept_name});
  EXPECT_TRUE(comparator.is_evidence(concept_name, area_id));
  EXPECT_NE(comparator.evidence_beside(bit(area_id)) & bit(concept_name), 0u);
  EXPECT_EQ(comparator.compare(here, kitchen), Truth::unknown);
  ASSERT_TRUE(comparator.competent_for(here, kitchen));
  EXPECT_EQ(comparator.competent_for(here, kitchen)->subarchitecture, "coma");
  comparator.answer(here, kitchen, Truth::yes);
  EXPECT_EQ(comparator.compare(kitchen, here), Truth::yes);
}

TEST(Features, AreShownInWords) {
  EXPECT_EQ(to_string(test::colour("red")), "colour red");
  EXPECT_EQ(to_string(not_from("vision")), "not other_source_id vision");
  EXPECT_EQ(to_string(location_at(0.1, 0.2, 0, "table")), "location table (0.1, 0.2, 0)");
  EXPECT_EQ(to_string(tether_to({{"vision", "0:3"}, "SceneObject"})),
            "source_data SceneObject vision/0:3");
}

} // namespace

} // namespace castor::binding::test
