#include "castor/communication/parsing/combinators.hpp"

#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/category_reader.hpp"
#include "castor/communication/parsing/chart.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

using namespace castor::communication;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

class CombinatorsTest : public testing::Test {
protected:
  CategoryId category(const std::string& text) {
    return categories_.intern(parse_category(text, features_, symbols_).category);
  }

  std::vector<std::string> combine(const std::string& left, const std::string& right) {
    std::vector<std::string> results;
    for (const auto& x : combinators_.combine(category(left), category(right)))
      results.push_back(to_string(categories_[x.result], symbols_));
    return results;
  }

  FeatureDeclarations features_{{{"number", {"sg", "pl"}}}};
  SymbolTable symbols_;
  CategoryTable categories_;
  Combinators combinators_{categories_};
};

} // namespace

TEST_F(CombinatorsTest, ApplyFunctionsToTheirNeighbours) {
  EXPECT_THAT(combine("np/n[sg]", "n[sg]"), ElementsAre("np"));
  EXPECT_THAT(combine("np", "s\\np"), ElementsAre("s"));
  EXPECT_THAT(combine("n[sg]", "np/n[sg]"), IsEmpty());
  EXPECT_THAT(combine("np/n[sg]", "n[pl]"), IsEmpty());
  EXPECT_THAT(combine("np[?number]/n[?number]", "n[pl]"), ElementsAre("np[pl]"));
  EXPECT_THAT(combine("np", "np"), IsEmpty());
}

TEST_F(CombinatorsTest, ComposeOverUpToTwoArguments) {
  EXPECT_THAT(combine("a/b", "b/c"), ElementsAre("a/c"));
  EXPECT_THAT(combine("a/b", "(b/c)/d"), ElementsAre("(a/c)/d"));
  EXPECT_THAT(combine("a/b", "((b/c)/d)/e"), IsEmpty());
  EXPECT_THAT(combine("b\\c", "a\\b"), ElementsAre("a\\c"));
  EXPECT_THAT(combine("a/b", "b\\c"), IsEmpty());
  EXPECT_THAT(combine("a/+b", "b\\+c"), ElementsAre("a\\+c"));
  EXPECT_THAT(combine("a/*b", "b/c"), IsEmpty());
}

TEST_F(CombinatorsTest, KnowCategoriesThatCameLater) {
  EXPECT_THAT(combine("a/b", "b"), ElementsAre("a"));
  EXPECT_THAT(combine("c/a", "a"), ElementsAre("c"));
}

TEST(MayUnify, IsTrueOfAllThatUnify) {
  const auto& known = english_lexicon()->categories();
  std::size_t unified = 0;
  for (CategoryId a = 0; a < known.size(); ++a)
    for (CategoryId b = 0; b < known.size(); ++b) {
      const auto other = with_variables_apart(known[b], 1000);
      if (!FeatureSubstitution().unify(known[a], other))
        continue;
      ++unified;
      EXPECT_TRUE(may_unify(known[a].result, other.result));
    }
  EXPECT_GE(unified, known.size());
}

TEST(CombinatoryGrammar, RemembersRootsAndRaisedCategories) {
  const auto english = english_lexicon();
  CombinatoryGrammar grammar{*english};
  const auto raisable = english->raising().front().category;
  const auto category = grammar.categories.intern(raisable);
  const auto raised = grammar.raised(category);
  ASSERT_THAT(raised, SizeIs(english->raising().size()));
  EXPECT_EQ(grammar.categories[raised.front()].arguments.size(), 1U);
  EXPECT_EQ(grammar.raised(category), raised);
  EXPECT_THAT(grammar.raised(raised.front()), IsEmpty());
  EXPECT_TRUE(grammar.is_root(grammar.categories.intern(english->roots().front())));
  EXPECT_FALSE(grammar.is_root(raised.front()));
  EXPECT_FALSE(grammar.is_root(raised.front()));
}
