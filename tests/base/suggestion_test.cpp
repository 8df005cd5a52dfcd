#include "castor/base/suggestion.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace castor {

namespace {

TEST(EditDistance, CountsChanges) {
  EXPECT_EQ(edit_distance("abc", "abc", 3), 0U);
  EXPECT_EQ(edit_distance("abc", "abd", 3), 1U);
  EXPECT_EQ(edit_distance("abc", "acb", 3), 1U);
  EXPECT_EQ(edit_distance("abc", "bc", 3), 1U);
  EXPECT_EQ(edit_distance("", "abc", 3), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting", 5), 3U);
}

TEST(EditDistance, StopsAtTheLimit) {
  EXPECT_EQ(edit_distance("abc", "xyz", 1), 2U);
  EXPECT_EQ(edit_distance("a", "abcdef", 2), 3U);
  EXPECT_EQ(edit_distance(std::string(100, 'a'), std::string(100, 'a'), 2), 3U);
}

TEST(Suggestions, TakeTheNearestCandidate) {
  std::vector<std::string_view> candidates{"HOST", "HOSTNAME", "COMPONENT"};
  EXPECT_EQ(nearest("HOTS", candidates), "HOST");
  EXPECT_EQ(nearest("hostname", candidates), "HOSTNAME");
  EXPECT_EQ(nearest("COMPONNET", candidates), "COMPONENT");
  EXPECT_EQ(nearest("vision", candidates), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("", candidates), "");
}

TEST(Suggestions, AreQuestions) {
  EXPECT_EQ(did_you_mean("HOTS", {"HOST"}), "did you mean 'HOST'?");
  EXPECT_EQ(did_you_mean("other", {"HOST"}), "");
  EXPECT_EQ(did_you_mean("HOST", {"HOST", "HOTS"}), "")
    << "it is there, and cannot be what was meant";
}

} // namespace

} // namespace castor
