#include "castor/binding/references.hpp"

#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/binding/reference/binding_core.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::test {

namespace {

using Ids = std::vector<std::string>;

/// Two red things, one of them left of the ball and the other right of it, and a blue box.
class References : public ::testing::Test {
protected:
  References() {
    see("red1", {concept_of("thing"), colour("red")});
    see("red2", {concept_of("thing"), colour("red")});
    see("ball", {concept_of("ball")});
    see("box", {concept_of("box"), colour("blue")});
    core.set("rel1", relation_from("vision", "left", "red1", "ball"));
    core.set("rel2", relation_from("vision", "left", "ball", "red2"));
  }

  void see(const std::string& id, std::vector<Feature> features) {
    features.push_back(not_from("vision"));
    core.set(id, proxy_from("vision", std::move(features)));
  }

  /// Where nothing is left open.
  Ids certain(const Description& description) const {
    Ids result;
    for (const auto& x : find_referents(description, core.unions(), core.comparator())) {
      if (x.unknown == 0)
        result.push_back(x.unions.front());
    }
    return result;
  }

  Ids firsts(const Description& description) const {
    Ids result;
    for (const auto& x :
         distinct_referents(find_referents(description, core.unions(), core.comparator())))
      result.push_back(x.unions.front());
    return result;
  }

  BindingCore core;
};

TEST_F(References, AreFoundByFeatures) {
  EXPECT_EQ(firsts({{{{concept_of("box")}}}, {}}),
            (Ids{"union of box", "union of red1", "union of red2"}));
  EXPECT_EQ(firsts({{{{concept_of("thing"), negation_of(colour("red"))}}}, {}}),
            (Ids{"union of box", "union of ball"}));
  EXPECT_TRUE(firsts({{{{colour("green"), concept_of("box")}}}, {}}).empty());
  EXPECT_TRUE(firsts({}).empty());
}

TEST_F(References, AreFoundByTheirRelations) {
  const DescribedThing red{{colour("red")}};
  const DescribedThing ball{{concept_of("ball")}};
  EXPECT_EQ(certain({{red, ball}, {{"left", 0, 1}}}), Ids{"union of red1"});
  EXPECT_EQ(certain({{red, ball}, {{"left", 1, 0}}}), Ids{"union of red2"});
  EXPECT_TRUE(firsts({{red, ball}, {{"near", 0, 1}}}).empty());
  // The one that is left of something that is left of something red.
  EXPECT_EQ(firsts({{{}, {}, red}, {{"left", 0, 1}, {"left", 1, 2}}}), Ids{"union of red1"});
  EXPECT_THROW(firsts({{red}, {{"left", 0, 1}}}), std::out_of_range);
}

TEST_F(References, SayHowCertainTheyAre) {
  EXPECT_EQ(certain({{{{concept_of("ball")}}}, {}}), Ids{"union of ball"});
  EXPECT_TRUE(certain({{{{concept_of("ball"), colour("red")}}}, {}}).empty());
  const auto found =
    find_referents({{{{concept_of("ball"), colour("red")}}}, {}}, core.unions(), core.comparator());
  // The ball has no colour that is known; what is red may be a ball.
  EXPECT_EQ(found, (std::vector<Referents>{
                     {{"union of ball"}, 1}, {{"union of red1"}, 1}, {{"union of red2"}, 1}}));
}

TEST_F(References, SeeThroughToWhatOthersSaid) {
  // Somebody calls the first red thing Bob.
  core.set("said", with_precedence(proxy_from("comsys", {concept_of("thing"), colour("red"),
                                                         feature(FeatureKind::name, "Bob")}),
                                   1));
  EXPECT_EQ(core.union_of("said"), "union of red1");
  const auto found =
    find_referents({{{{feature(FeatureKind::name, "Bob")}}}, {}}, core.unions(), core.comparator());
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0], (Referents{{"union of red1"}, 0}));
}

TEST_F(References, LeaveNoReadingOut) {
  const Description any_two{{{}, {}}, {}};
  EXPECT_EQ(find_referents(any_two, core.unions(), core.comparator()).size(), 12u);
  EXPECT_EQ(find_referents(any_two, core.unions(), core.comparator(), 5).size(), 5u);
}

TEST_F(References, GoByRelationsBetweenUnions) {
  EXPECT_EQ(relations_between(core.unions()),
            (std::vector<UnionRelation>{{"left", "union of ball", "union of red2"},
                                        {"left", "union of red1", "union of ball"}}));
  core.set("rel3", relation_from("spatial", "near", "ball", "nowhere"));
  EXPECT_EQ(relations_between(core.unions()).size(), 2u);
}

} // namespace

} // namespace castor::binding::test
