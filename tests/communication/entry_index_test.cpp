#include "castor/communication/dialogue/entry_index.hpp"

#include "castor/communication/lexicon/english_lexicon.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <tuple>
#include <vector>

using namespace castor::communication;

namespace {

const Lexicon& english() {
  static const auto lexicon = english_lexicon();
  return *lexicon;
}

bool is_said_by(const Predication& predication, const std::vector<Predication>& said) {
  return std::ranges::any_of(said, [&](const auto& x) {
    return std::tie(x.kind, x.name, x.value) ==
           std::tie(predication.kind, predication.name, predication.value);
  });
}

bool mean_the_same(const LexicalEntry& a, const LexicalEntry& b) {
  return std::tie(a.family, a.category, a.predications) ==
         std::tie(b.family, b.category, b.predications);
}

} // namespace

TEST(EntryIndex, FindsEveryEntryAllOfWhichIsSaidOrOneThatMeansTheSame) {
  const EntryIndex index{english()};
  for (std::uint32_t number = 0; number < english().entries().size(); number += 7) {
    const auto said = english().entry(number).predications;
    const auto found = index.candidates(said);
    EXPECT_TRUE(std::ranges::is_sorted(found));
    for (const auto& entry : english().entries()) {
      const bool is_expressible =
        !entry.predications.empty() &&
        std::ranges::all_of(entry.predications, [&](const auto& x) { return is_said_by(x, said); });
      if (!is_expressible)
        continue;
      EXPECT_TRUE(std::ranges::any_of(
        found, [&](auto x) { return mean_the_same(english().entry(x), entry); }))
        << entry.phrase;
    }
  }
}

TEST(EntryIndex, FindsFewOthers) {
  const EntryIndex index{english()};
  const auto red = english().find("red");
  ASSERT_FALSE(red.empty());
  const auto found = index.candidates(english().entry(red.front()).predications);
  EXPECT_LT(found.size(), english().entries().size() / 10);
}

TEST(EntryIndex, KeepsTheFirstOfThoseThatMeanTheSame) {
  const EntryIndex index{english()};
  const auto found = index.candidates({});
  for (const auto a : found)
    for (const auto b : found)
      EXPECT_TRUE(a == b || !mean_the_same(english().entry(a), english().entry(b)));
}
