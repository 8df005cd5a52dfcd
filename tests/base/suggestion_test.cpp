#include "castor/base/suggestion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
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

/// Without a limit, by all pairs of beginnings.
std::size_t distance_by_all_beginnings(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> table(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      auto& distance = table[i][j];
      distance = std::max(i, j);
      if (i == 0 || j == 0)
        continue;
      distance = std::min({table[i - 1][j] + 1, table[i][j - 1] + 1,
                           table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        distance = std::min(distance, table[i - 2][j - 2] + 1);
    }
  return table[a.size()][b.size()];
}

TEST(EditDistance, IsThatOfAllBeginningsUpToTheLimit) {
  std::mt19937 random{1};
  const auto word = [&] {
    std::string result(random() % 9, ' ');
    for (auto& letter : result)
      letter = "abc"[random() % 3];
    return result;
  };
  for (int i = 0; i < 20'000; ++i) {
    const auto a = word();
    const auto b = word();
    const auto limit = random() % 10;
    EXPECT_EQ(edit_distance(a, b, limit), std::min(distance_by_all_beginnings(a, b), limit + 1))
      << a << ' ' << b << ' ' << limit;
  }
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
