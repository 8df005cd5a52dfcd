#include "castor/planning/symbolic/tuple_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace castor::planning {
namespace {

TEST(TupleTable, NumbersEachTupleOnce) {
  std::mt19937 random(1);
  TupleTable table;
  std::map<std::vector<int>, int> known;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<int> tuple(random() % 4);
    for (auto& x : tuple)
      x = static_cast<int>(random() % 30) - 5;
    const auto found = known.find(tuple);
    ASSERT_EQ(table.find(tuple), found == known.end() ? -1 : found->second);
    const auto [number, is_new] = table.add(tuple);
    EXPECT_EQ(is_new, found == known.end());
    if (is_new)
      known.emplace(tuple, number);
    ASSERT_EQ(number, known.at(tuple));
    ASSERT_EQ(table.size(), known.size());
  }
  for (const auto& [tuple, number] : known) {
    const auto stored = table[static_cast<std::size_t>(number)];
    EXPECT_EQ(std::vector<int>(stored.begin(), stored.end()), tuple);
  }
}

} // namespace
} // namespace castor::planning
